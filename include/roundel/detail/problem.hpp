/// The mixed-integer quadratic problem and how it is built.

#ifndef ROUNDEL_DETAIL_PROBLEM_HPP
#define ROUNDEL_DETAIL_PROBLEM_HPP

#include <roundel/detail/error.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// Which entries of a symmetric matrix are given.
enum class Triangle : std::int32_t {
    /// Both triangles, which must agree.
    full = ROUNDEL_TRIANGLE_FULL,
    /// Only entries with row <= column, which stand for both.
    upper = ROUNDEL_TRIANGLE_UPPER,
    /// Only entries with row >= column, which stand for both.
    lower = ROUNDEL_TRIANGLE_LOWER,
};

/// Whether a compressed matrix is stored column by column (CSC) or row by row (CSR).
enum class Layout { columns, rows };

/// A compressed sparse matrix in the caller's arrays: column (or row) k has the entries from
/// offsets[k] to before offsets[k + 1]. Index is std::int32_t or std::int64_t.
template <class Index> struct Compressed {
    static_assert(std::is_same_v<Index, std::int32_t> || std::is_same_v<Index, std::int64_t>,
                  "indices must be std::int32_t or std::int64_t");
    Layout layout;
    span<const Index> offsets;
    span<const Index> indices;
    span<const double> values;
};

namespace detail {

/// Access of Problem to another library's sparse matrix. An adapter specialises it with a
/// constructor from the matrix and `Compressed<Index> get() const`.
template <class Matrix> class CompressedView;

template <class Matrix>
using if_compressed = decltype(CompressedView<Matrix>(std::declval<const Matrix&>()).get());

} // namespace detail

/// A mixed-integer quadratic problem under construction: minimise
/// 1/2 x'Qx + q'x + c + sum_k w_k (a_k . x - r_k)^2 subject to C x = d,
/// l_G <= G x <= u_G, l <= x <= u, x_i integer for i in I.
///
/// Parts may be added in any order and any number of times; terms are summed. A call that fails
/// changes nothing.
class Problem {
  public:
    using Indices = span<const std::int32_t>;
    using Numbers = span<const double>;

    /// A problem of `variables` unknowns whose objective is zero.
    explicit Problem(std::size_t variables, Status* status = nullptr) {
        roundel_problem* made = nullptr;
        detail::check(roundel_problem_new(variables, &made), status);
        handle_.reset(made);
    }

    /// Takes ownership of a problem of the C interface.
    explicit Problem(roundel_problem* owned) noexcept : handle_(owned) {}

    /// An independent copy.
    Problem clone(Status* status = nullptr) const {
        roundel_problem* copy = nullptr;
        detail::check(roundel_problem_clone(get(), &copy), status);
        return Problem(copy);
    }

    std::size_t variables(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_problem_variable_count(get(), &count), status);
        return count;
    }

    /// The number of constraints so far, which is also the index of the next one.
    std::size_t constraints(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_problem_constraint_count(get(), &count), status);
        return count;
    }

    /// The number of inequalities so far, which is also the index of the next one.
    std::size_t inequalities(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_problem_inequality_count(get(), &count), status);
        return count;
    }

    /// Adds entries to Q. Duplicates are summed.
    void quadratic(Triangle triangle, Indices rows, Indices columns, Numbers values,
                   Status* status = nullptr) {
        add_triplets(roundel_problem_add_quadratic_triplets, triangle, rows, columns, values,
                     status);
    }

    /// The same with 64-bit indices.
    void quadratic(Triangle triangle, span<const std::int64_t> rows,
                   span<const std::int64_t> columns, Numbers values, Status* status = nullptr) {
        add_triplets(roundel_problem_add_quadratic_triplets_i64, triangle, rows, columns, values,
                     status);
    }

    /// Adds a compressed matrix to Q.
    template <class Index>
    void quadratic(const Compressed<Index>& matrix, Triangle triangle, Status* status = nullptr) {
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status)) {
            return;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), static_cast<std::int32_t>(triangle), matrix.offsets.size(),
                            matrix.offsets.data(), matrix.indices.size(), matrix.indices.data(),
                            matrix.values.data());
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_quadratic_csc_i64)
                           : add(roundel_problem_add_quadratic_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_quadratic_csc)
                           : add(roundel_problem_add_quadratic_csr);
        }
        detail::check(code, status);
    }

    /// Adds another library's matrix to Q, such as Eigen's with <roundel/eigen.hpp>.
    template <class Matrix, class = detail::if_compressed<Matrix>>
    void quadratic(const Matrix& matrix, Triangle triangle, Status* status = nullptr) {
        const detail::CompressedView<Matrix> view(matrix);
        quadratic(view.get(), triangle, status);
    }

    /// Adds to the linear term, one number for each variable.
    void linear(Numbers values, Status* status = nullptr) {
        detail::check(roundel_problem_add_linear(get(), values.data(), values.size()), status);
    }

    /// Adds to the linear term of one variable.
    void linear(std::int64_t variable, double coefficient, Status* status = nullptr) {
        detail::check(roundel_problem_add_linear_term(get(), variable, coefficient), status);
    }

    /// Adds a constant to the objective.
    void constant(double value, Status* status = nullptr) {
        detail::check(roundel_problem_add_constant(get(), value), status);
    }

    /// Adds weight (sum_k coefficients[k] x[indices[k]] - rhs)^2 to the objective, without a factor
    /// of 1/2, and returns the index of the row.
    std::size_t least_squares(Indices indices, Numbers coefficients, double rhs = 0.0,
                              double weight = 1.0, Status* status = nullptr) {
        std::size_t row = 0;
        if (detail::same_length(indices.size(), coefficients.size(), status)) {
            detail::check(roundel_problem_add_least_squares(get(), indices.size(), indices.data(),
                                                            coefficients.data(), rhs, weight, &row),
                          status);
        }
        return row;
    }

    std::size_t least_squares(std::initializer_list<std::int32_t> indices,
                              std::initializer_list<double> coefficients, double rhs = 0.0,
                              double weight = 1.0, Status* status = nullptr) {
        return least_squares(Indices(indices.begin(), indices.size()),
                             Numbers(coefficients.begin(), coefficients.size()), rhs, weight,
                             status);
    }

    /// Adds sum_i weights[i] ((A x)_i - rhs[i])^2, one term for each row of the matrix, and returns
    /// the index of the first row. Without `weights` all are 1. A failure adds nothing.
    template <class Index>
    std::size_t least_squares(const Compressed<Index>& matrix, Numbers rhs, Numbers weights = {},
                              Status* status = nullptr) {
        std::size_t first = 0;
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status) ||
            (!weights.empty() && !detail::same_length(rhs.size(), weights.size(), status))) {
            return first;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), matrix.offsets.size(), matrix.offsets.data(),
                            matrix.indices.size(), matrix.indices.data(), matrix.values.data(),
                            rhs.size(), rhs.data(), weights.empty() ? nullptr : weights.data(),
                            &first);
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_least_squares_csc_i64)
                           : add(roundel_problem_add_least_squares_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_least_squares_csc)
                           : add(roundel_problem_add_least_squares_csr);
        }
        detail::check(code, status);
        return first;
    }

    /// Adds |A x - rhs|^2 with another library's matrix and vector.
    template <class Matrix, class Vector, class = detail::if_compressed<Matrix>>
    std::size_t least_squares(const Matrix& matrix, const Vector& rhs, Status* status = nullptr) {
        const detail::CompressedView<Matrix> view(matrix);
        return least_squares(view.get(), Numbers(rhs.data(), static_cast<std::size_t>(rhs.size())),
                             Numbers(), status);
    }

    /// Adds the constraint sum_k coefficients[k] x[indices[k]] = rhs.
    void constrain(Indices indices, Numbers coefficients, double rhs, Status* status = nullptr) {
        if (detail::same_length(indices.size(), coefficients.size(), status)) {
            detail::check(roundel_problem_add_constraint(get(), indices.size(), indices.data(),
                                                         coefficients.data(), rhs),
                          status);
        }
    }

    void constrain(std::initializer_list<std::int32_t> indices,
                   std::initializer_list<double> coefficients, double rhs,
                   Status* status = nullptr) {
        constrain(Indices(indices.begin(), indices.size()),
                  Numbers(coefficients.begin(), coefficients.size()), rhs, status);
    }

    /// Adds the constraints C x = rhs, one for each row of the matrix, and returns the index of the
    /// first.
    template <class Index>
    std::size_t constrain(const Compressed<Index>& matrix, Numbers rhs, Status* status = nullptr) {
        std::size_t first = 0;
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status)) {
            return first;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), matrix.offsets.size(), matrix.offsets.data(),
                            matrix.indices.size(), matrix.indices.data(), matrix.values.data(),
                            rhs.size(), rhs.data(), &first);
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_constraints_csc_i64)
                           : add(roundel_problem_add_constraints_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_constraints_csc)
                           : add(roundel_problem_add_constraints_csr);
        }
        detail::check(code, status);
        return first;
    }

    /// Adds the constraints C x = rhs with another library's matrix and vector.
    template <class Matrix, class Vector, class = detail::if_compressed<Matrix>>
    std::size_t constrain(const Matrix& matrix, const Vector& rhs, Status* status = nullptr) {
        const detail::CompressedView<Matrix> view(matrix);
        return constrain(view.get(), Numbers(rhs.data(), static_cast<std::size_t>(rhs.size())),
                         status);
    }

    /// Adds the inequality lower <= sum_k coefficients[k] x[indices[k]] <= upper and returns its
    /// index. A side that does not limit is infinite.
    std::size_t inequality(Indices indices, Numbers coefficients, double lower, double upper,
                           Status* status = nullptr) {
        std::size_t row = 0;
        if (detail::same_length(indices.size(), coefficients.size(), status)) {
            detail::check(roundel_problem_add_inequality(get(), indices.size(), indices.data(),
                                                         coefficients.data(), lower, upper, &row),
                          status);
        }
        return row;
    }

    std::size_t inequality(std::initializer_list<std::int32_t> indices,
                           std::initializer_list<double> coefficients, double lower, double upper,
                           Status* status = nullptr) {
        return inequality(Indices(indices.begin(), indices.size()),
                          Numbers(coefficients.begin(), coefficients.size()), lower, upper, status);
    }

    /// Adds the inequalities lower <= G x <= upper, one for each row of the matrix, and returns the
    /// index of the first.
    template <class Index>
    std::size_t inequality(const Compressed<Index>& matrix, Numbers lower, Numbers upper,
                           Status* status = nullptr) {
        std::size_t first = 0;
        if (!detail::same_length(matrix.indices.size(), matrix.values.size(), status) ||
            !detail::same_length(lower.size(), upper.size(), status)) {
            return first;
        }
        constexpr bool wide = std::is_same_v<Index, std::int64_t>;
        const auto add = [&](auto function) {
            return function(get(), matrix.offsets.size(), matrix.offsets.data(),
                            matrix.indices.size(), matrix.indices.data(), matrix.values.data(),
                            lower.size(), lower.data(), upper.data(), &first);
        };
        const bool columns = matrix.layout == Layout::columns;
        roundel_status code;
        if constexpr (wide) {
            code = columns ? add(roundel_problem_add_inequalities_csc_i64)
                           : add(roundel_problem_add_inequalities_csr_i64);
        } else {
            code = columns ? add(roundel_problem_add_inequalities_csc)
                           : add(roundel_problem_add_inequalities_csr);
        }
        detail::check(code, status);
        return first;
    }

    /// Adds the inequalities lower <= G x <= upper with another library's matrix and vectors.
    template <class Matrix, class Vector, class = detail::if_compressed<Matrix>>
    std::size_t inequality(const Matrix& matrix, const Vector& lower, const Vector& upper,
                           Status* status = nullptr) {
        const detail::CompressedView<Matrix> view(matrix);
        return inequality(view.get(), Numbers(lower.data(), static_cast<std::size_t>(lower.size())),
                          Numbers(upper.data(), static_cast<std::size_t>(upper.size())), status);
    }

    /// Sets lower[k] <= x[variables[k]] <= upper[k], in place of earlier bounds of these variables.
    /// A bound that does not limit is infinite.
    void bounds(Indices variables, Numbers lower, Numbers upper, Status* status = nullptr) {
        if (detail::same_length(variables.size(), lower.size(), status) &&
            detail::same_length(variables.size(), upper.size(), status)) {
            detail::check(roundel_problem_set_bounds(get(), variables.size(), variables.data(),
                                                     lower.data(), upper.data()),
                          status);
        }
    }

    /// Sets the bounds of one variable.
    void bounds(std::int32_t variable, double lower, double upper, Status* status = nullptr) {
        detail::check(roundel_problem_set_bounds(get(), 1, &variable, &lower, &upper), status);
    }

    /// The lower and the upper bounds of all variables, infinite where there is none.
    std::pair<std::vector<double>, std::vector<double>> bounds(Status* status = nullptr) const {
        std::pair<std::vector<double>, std::vector<double>> both;
        const std::size_t count = variables(status);
        both.first.resize(count);
        both.second.resize(count);
        detail::check(roundel_problem_bounds(get(), both.first.data(), both.second.data(), count),
                      status);
        return both;
    }

    /// Makes variables binary: integer, with the bounds 0 and 1.
    void binary(Indices variables, Status* status = nullptr) {
        detail::check(roundel_problem_set_binaries(get(), variables.size(), variables.data()),
                      status);
    }

    void binary(std::initializer_list<std::int32_t> variables, Status* status = nullptr) {
        binary(Indices(variables.begin(), variables.size()), status);
    }

    /// Makes variables integer.
    void integer(Indices variables, Status* status = nullptr) {
        detail::check(roundel_problem_set_integers(get(), variables.size(), variables.data()),
                      status);
    }

    void integer(std::initializer_list<std::int32_t> variables, Status* status = nullptr) {
        integer(Indices(variables.begin(), variables.size()), status);
    }

    /// Fixes one variable to a value.
    void pin(std::int64_t variable, double value, Status* status = nullptr) {
        detail::check(roundel_problem_pin(get(), variable, value), status);
    }

    /// Releases a pinned variable.
    void unpin(std::int64_t variable, Status* status = nullptr) {
        detail::check(roundel_problem_unpin(get(), variable), status);
    }

    /// Sets the point whose values variables keep where the objective does not determine them.
    void guess(Numbers values, Status* status = nullptr) {
        detail::check(roundel_problem_set_guess(get(), values.data(), values.size()), status);
    }

    /// Adds short cycles that the caller knows: sums of least-squares rows with sign 1 or -1 in
    /// which all continuous variables cancel. Cycle k has the entries from offsets[k] to before
    /// offsets[k + 1]. A hint never changes the problem.
    void hint_cycles(Indices offsets, Indices rows, span<const std::int8_t> signs,
                     Status* status = nullptr) {
        if (detail::same_length(rows.size(), signs.size(), status)) {
            detail::check(roundel_problem_hint_cycles(get(), offsets.size(), offsets.data(),
                                                      rows.size(), rows.data(), signs.data()),
                          status);
        }
    }

    /// Reads a problem from a file in the format that its name says: LP for ".lp", QPLIB for
    /// ".qplib" and MPS for any other, each also with ".gz" behind it. A file may maximise: the
    /// problem then minimises the negated objective, and `maximises` tells it.
    static Problem read(const std::string& file, bool* maximises = nullptr,
                        Status* status = nullptr) {
        roundel_problem* made = nullptr;
        std::int32_t negated = 0;
        detail::check(roundel_problem_read(file.c_str(), &negated, &made), status);
        if (maximises) {
            *maximises = negated != 0;
        }
        return Problem(made);
    }

    /// Writes LP for a name that ends in ".lp" and free-format MPS for any other, each compressed
    /// for
    /// ".gz" behind it. Pins are written as constraints. The guess is not written.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_problem_write(get(), file.c_str()), status);
    }

    /// Reads a problem from a file in MPS, gzipped or not, whatever its name is.
    static Problem read_mps(const std::string& file, Status* status = nullptr) {
        roundel_problem* made = nullptr;
        detail::check(roundel_problem_read_mps(file.c_str(), &made), status);
        return Problem(made);
    }

    /// Writes free-format MPS, gzipped if the name ends in ".gz". Pins are written as constraints.
    /// The guess is not written.
    void write_mps(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_problem_write_mps(get(), file.c_str()), status);
    }

    /// Gives up the object of the C interface.
    roundel_problem* release() noexcept { return handle_.release(); }

    /// The object of the C interface; nullptr after a move.
    roundel_problem* get() noexcept { return handle_.get(); }
    const roundel_problem* get() const noexcept { return handle_.get(); }

  private:
    template <class Function, class Index>
    void add_triplets(Function function, Triangle triangle, span<const Index> rows,
                      span<const Index> columns, Numbers values, Status* status) {
        if (detail::same_length(rows.size(), columns.size(), status) &&
            detail::same_length(rows.size(), values.size(), status)) {
            detail::check(function(get(), static_cast<std::int32_t>(triangle), rows.size(),
                                   rows.data(), columns.data(), values.data()),
                          status);
        }
    }

    detail::Handle<roundel_problem, roundel_problem_free> handle_;
};

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_PROBLEM_HPP
