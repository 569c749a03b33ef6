/// The settings of CoMISo's mixed-integer solver: how integers are rounded.

#ifndef COMISO_ROUNDEL_ROUNDING_HH
#define COMISO_ROUNDEL_ROUNDING_HH

#include <CoMISo/Config/CoMISoDefines.hh>

#include <string>
#include <utility>

namespace COMISO {
namespace roundel_detail {

/// Settings of the mixed-integer solver. `inital_full` is spelt as in CoMISo.
///
/// If several kinds of rounding are set, the first of these counts: Gurobi, CPLEX, none, direct,
/// multiple. Without any, integers are rounded one at a time. Multiple rounding is on by default.
class COMISODLLEXPORT Rounding {
  public:
    enum class RoundingType { NONE, DIRECT, MULTIPLE, GUROBI, CPLEX, DEFAULT = MULTIPLE };

    Rounding() = default;
    Rounding(const Rounding&) = delete;
    Rounding& operator=(const Rounding&) = delete;

    /// Whether to solve exactly before the first rounding. Roundel always does.
    void set_inital_full(bool on = true) { inital_full_ = on; }
    bool get_inital_full() const { return inital_full_; }

    /// Whether to solve exactly between roundings when the iterations fail.
    void set_iter_full(bool on = true) { iter_full_ = on; }
    bool get_iter_full() const { return iter_full_; }

    /// Whether to solve exactly after the last rounding. Roundel always does.
    void set_final_full(bool on = true) { final_full_ = on; }
    bool get_final_full() const { return final_full_; }

    /// Rounds all integers of the relaxation at once.
    void set_direct_rounding(bool on = true) { direct_rounding_ = on; }
    bool get_direct_rounding() const { return direct_rounding_; }

    /// Leaves integers at their relaxed values.
    void set_no_rounding(bool on = true) { no_rounding_ = on; }
    bool get_no_rounding() const { return no_rounding_; }

    /// Rounds several integers at a time.
    void set_multiple_rounding(bool on = true) { multiple_rounding_ = on; }
    bool get_multiple_rounding() const { return multiple_rounding_; }

    /// Asks for Gurobi. Roundel uses its strategy "exact" instead and logs that.
    void set_gurobi_rounding(bool on = true) { gurobi_rounding_ = on; }
    bool get_gurobi_rounding() const { return gurobi_rounding_; }

    /// Asks for CPLEX. Roundel uses its strategy "exact" instead and logs that.
    void set_cplex_rounding(bool on = true) { cplex_rounding_ = on; }
    bool get_cplex_rounding() const { return cplex_rounding_; }

    /// Chooses one kind of rounding and turns off the others.
    void set_rounding_type(RoundingType type) {
        no_rounding_ = type == RoundingType::NONE;
        direct_rounding_ = type == RoundingType::DIRECT;
        multiple_rounding_ = type == RoundingType::MULTIPLE;
        gurobi_rounding_ = type == RoundingType::GUROBI;
        cplex_rounding_ = type == RoundingType::CPLEX;
    }

    /// The number of Gauss-Seidel updates after a rounding.
    void set_local_iters(unsigned int count) { local_iters_ = count; }
    unsigned int get_local_iters() const { return local_iters_; }

    /// The change of an unknown above which Gauss-Seidel updates its neighbours.
    void set_local_error(double tolerance) { local_error_ = tolerance; }
    double get_local_error() const { return local_error_; }

    /// The number of conjugate-gradient iterations after a rounding.
    void set_cg_iters(unsigned int count) { cg_iters_ = count; }
    unsigned int get_cg_iters() const { return cg_iters_; }

    /// The residual at which conjugate gradients stop.
    void set_cg_error(double tolerance) { cg_error_ = tolerance; }
    double get_cg_error() const { return cg_error_; }

    /// The largest sum of deviations of integers that are rounded together.
    void set_multiple_rounding_threshold(double sum) { multiple_rounding_threshold_ = sum; }
    double get_multiple_rounding_threshold() const { return multiple_rounding_threshold_; }

    /// Stores the level of messages. It has no effect: nothing is printed.
    void set_noise(unsigned int level) { noise_ = level; }
    unsigned int get_noise() const { return noise_; }

    /// The time limit in seconds of a solve that asks for Gurobi.
    void set_gurobi_max_time(double seconds) { gurobi_max_time_ = seconds; }
    double get_gurobi_max_time() const { return gurobi_max_time_; }

    /// Whether to log how a solve went.
    void set_stats(bool on = true) { stats_ = on; }
    bool get_stats() const { return stats_; }

    /// Whether constraints may be reordered. Roundel always does, which affects only the time.
    bool& use_constraint_reordering() { return constraint_reordering_; }
    void set_use_constraint_reordering(bool on) { constraint_reordering_ = on; }

    /// Chooses one of Roundel's strategies instead of the kind of rounding above. This has no
    /// effect if rounding is turned off (set_no_rounding). An empty name undoes the choice.
    /// Overrides the function set_roundel_strategy and the environment.
    void set_roundel_strategy(std::string strategy) { strategy_ = std::move(strategy); }
    const std::string& get_roundel_strategy() const { return strategy_; }

    /// The kind of rounding that is used.
    RoundingType get_rounding_type() const {
        return gurobi_rounding_   ? RoundingType::GUROBI
               : cplex_rounding_  ? RoundingType::CPLEX
               : no_rounding_     ? RoundingType::NONE
               : direct_rounding_ ? RoundingType::DIRECT
                                  : RoundingType::MULTIPLE;
    }

  private:
    bool inital_full_ = true;
    bool iter_full_ = true;
    bool final_full_ = true;
    bool direct_rounding_ = false;
    bool no_rounding_ = false;
    bool multiple_rounding_ = true;
    bool gurobi_rounding_ = false;
    bool cplex_rounding_ = false;
    bool stats_ = false;
    bool constraint_reordering_ = true;
    unsigned int local_iters_ = 100000;
    unsigned int cg_iters_ = 50;
    unsigned int noise_ = 0;
    double local_error_ = 1e-3;
    double cg_error_ = 1e-3;
    double multiple_rounding_threshold_ = 0.5;
    double gurobi_max_time_ = 60.0;
    std::string strategy_;
};

} // namespace roundel_detail
} // namespace COMISO

#endif // COMISO_ROUNDEL_ROUNDING_HH
