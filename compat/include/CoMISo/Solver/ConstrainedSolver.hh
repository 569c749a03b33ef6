/// CoMISo's mixed-integer solver with linear constraints: the same interface, solved by Roundel.

#ifndef COMISO_SOLVER_CONSTRAINEDSOLVER_HH
#define COMISO_SOLVER_CONSTRAINEDSOLVER_HH

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>
#include <CoMISo/Roundel/Choice.hh>
#include <CoMISo/Roundel/Matrices.hh>
#include <CoMISo/Roundel/Problem.hh>
#include <CoMISo/Roundel/Settings.hh>
#include <CoMISo/Solver/GMM_Tools.hh>
#include <CoMISo/Solver/MISolver.hh>

#include <roundel/roundel.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace COMISO {

/// Minimises x'Ax - 2 x'b, which is stationary where A x = b, subject to rows c . x + c_{n+1} = 0
/// and with some unknowns integer.
///
/// A is symmetric and stored in full. The functions change no argument but x. Redundant constraints
/// are dropped. A contradictory constraint, or anything else that cannot be solved, throws a
/// roundel::Error that names the row, and leaves x unchanged.
class COMISODLLEXPORT ConstrainedSolver {
  public:
    /// The types of constraints and of A.
    using RowMatrix = gmm::row_matrix<gmm::wsvector<double>>;
    using CSCMatrix = gmm::csc_matrix<double>;

    /// Coefficients of integers are always divided by their common divisors, whatever the argument.
    explicit ConstrainedSolver(bool /*do_gcd*/ = true) {}
    ConstrainedSolver(const ConstrainedSolver&) = delete;
    ConstrainedSolver& operator=(const ConstrainedSolver&) = delete;

    /// The settings for rounding.
    MISolver& misolver() { return settings_; }
    const MISolver& misolver() const { return settings_; }

    /// Solves for x, which is resized. `reg` has no effect, as in CoMISo. Timings go to the log
    /// (set_roundel_log). No dialog is shown.
    template <class Constraints, class Matrix, class Vector, class Right, class Indices,
              class = std::enable_if_t<!std::is_arithmetic_v<Indices>>>
    void solve(Constraints& constraints, Matrix& A, Vector& x, Right& b, Indices& idx_to_round,
               double reg = 0.0, bool show_miso_settings = true, bool show_timings = true) {
        solve_const(constraints, A, x, b, idx_to_round, reg, show_miso_settings, show_timings);
    }

    /// The same as solve.
    template <class Constraints, class Matrix, class Vector, class Right, class Indices,
              class = std::enable_if_t<!std::is_arithmetic_v<Indices>>>
    void solve_const(const Constraints& constraints, const Matrix& A, Vector& x, const Right& b,
                     const Indices& idx_to_round, double /*reg*/ = 0.0,
                     bool /*show_miso_settings*/ = true, bool show_timings = true) {
        std::vector<double> right = roundel_detail::numbers_of(b);
        auto problem = roundel_detail::quadratic_problem(roundel_detail::entries_of(A), right);
        shift_.assign(right.size(), 0.0);
        run(std::move(problem), roundel_detail::entries_of(constraints), idx_to_round, x,
            show_timings);
    }

    /// Solves least squares: minimises |B (x, 1)|^2, where the last column of B is the negated
    /// right side. `reg` times the mean of the diagonal of A = B'B is added to the diagonal of A.
    template <class Constraints, class Matrix, class Vector, class Indices>
    void solve(Constraints& constraints, Matrix& B, Vector& x, Indices& idx_to_round,
               double reg = 0.0, bool show_miso_settings = true, bool show_timings = true) {
        solve_const(constraints, B, x, idx_to_round, reg, show_miso_settings, show_timings);
    }

    /// The same as the least-squares solve.
    template <class Constraints, class Matrix, class Vector, class Indices>
    void solve_const(const Constraints& constraints, const Matrix& B, Vector& x,
                     const Indices& idx_to_round, double reg = 0.0,
                     bool /*show_miso_settings*/ = true, bool show_timings = true) {
        auto problem =
            roundel_detail::least_squares_problem(roundel_detail::entries_of(B), reg, shift_);
        run(std::move(problem), roundel_detail::entries_of(constraints), idx_to_round, x,
            show_timings);
    }

    /// Solves the last problem again with other right sides: those of the constraints, c . x =
    /// right side, one a row (the opposite sign of the last column), and that of A x = b. A right
    /// side that is left out or a null pointer stays unchanged. Integers are decided anew, while
    /// eliminations and factorizations are reused.
    template <class Vector, class Constraints = std::nullptr_t, class Right = std::nullptr_t>
    void resolve(Vector& x, const Constraints& constraint_rhs = nullptr, const Right& rhs = nullptr,
                 bool show_timings = true) {
        if (!solver_) {
            roundel_detail::refuse(ROUNDEL_ERROR_INVALID_ARGUMENT,
                                   "resolve needs a solve before it");
        }
        std::vector<double> numbers;
        if (read(constraint_rhs, numbers)) {
            check(roundel_solver_set_constraint_right_sides(solver_.get(), numbers.data(),
                                                            numbers.size()));
        }
        if (read(rhs, numbers)) {
            for (std::size_t i = 0; i < numbers.size() && i < shift_.size(); ++i) {
                numbers[i] = 2.0 * (shift_[i] - numbers[i]);
            }
            check(roundel_solver_set_linear(solver_.get(), numbers.data(), numbers.size()));
        }
        answer(x, show_timings || settings_.get_stats());
    }

    /// Stores the smallest coefficient that counts. It has no effect: Roundel uses its own
    /// tolerances.
    void set_epsilon(double epsilon) { epsilon_ = epsilon; }
    double epsilon() const { return epsilon_; }

    /// Stores the level of messages. It has no effect: nothing is printed.
    void set_noisy(int level) { noisy_ = level; }
    int noisy() const { return noisy_; }

    /// The same flag as in the settings.
    bool& use_constraint_reordering() { return settings_.use_constraint_reordering(); }
    void set_use_constraint_reordering(bool on) { settings_.set_use_constraint_reordering(on); }

    /// The energy of the last solution: x'Ax - 2 x'b, or |B (x, 1)|^2.
    double roundel_energy() const { return energy_; }

  private:
    struct Free {
        void operator()(roundel_solver* solver) const noexcept { roundel_solver_free(solver); }
    };

    static void check(roundel_status code, std::size_t unknowns = 0) {
        ::roundel::detail::check(code, nullptr, unknowns);
    }

    /// The numbers of a vector, or of a vector behind a pointer. Returns false for a null pointer.
    template <class Vector> static bool read(const Vector& vector, std::vector<double>& numbers) {
        if constexpr (std::is_same_v<Vector, std::nullptr_t> || std::is_arithmetic_v<Vector>) {
            return false;
        } else if constexpr (std::is_pointer_v<Vector>) {
            return vector && read(*vector, numbers);
        } else {
            numbers = roundel_detail::numbers_of(vector);
            return true;
        }
    }

    template <class Indices, class Vector>
    void run(::roundel::Problem&& problem, const roundel_detail::Entries& constraints,
             const Indices& idx_to_round, Vector& x, bool show_timings) {
        roundel_detail::constrain(problem, constraints, shift_.size());
        roundel_detail::make_integer(problem, idx_to_round);
        roundel_solver* made = nullptr;
        check(roundel_solver_new(problem.get(), &made));
        solver_.reset(made);
        answer(x, show_timings || settings_.get_stats());
    }

    template <class Vector> void answer(Vector& x, bool tell) {
        const auto call = [this](const roundel_options* how, const roundel_monitor* monitor,
                                 roundel_solution** made) {
            return roundel_solver_solve(solver_.get(), how, monitor, made);
        };
        const ::roundel::Options options = roundel_detail::options_for(settings_);
        const ::roundel::Solution solution =
            ::roundel::detail::solution_of(options, call, shift_.size(), nullptr);
        roundel_detail::store(solution, x);
        energy_ = solution.energy();
        if (tell) {
            roundel_detail::log_timings(options, solution);
        }
    }

    MISolver settings_;
    // A handle of the C interface, which has the same type in every C++ standard.
    std::unique_ptr<roundel_solver, Free> solver_;
    /// The right side of A x = b that comes from the least-squares rows, or zero without such rows.
    std::vector<double> shift_;
    double energy_ = 0.0;
    double epsilon_ = 1e-8;
    int noisy_ = 0;
};

} // namespace COMISO

#endif // COMISO_SOLVER_CONSTRAINEDSOLVER_HH
