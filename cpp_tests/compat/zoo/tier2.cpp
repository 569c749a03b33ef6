// Objectives and constraints given as functions.

#include "zoo.hpp"

#include <CoMISo/NSolver/COMISOSolver.hh>
#include <CoMISo/NSolver/FiniteElementProblem.hh>
#include <CoMISo/NSolver/LinearConstraint.hh>
#include <CoMISo/NSolver/NConstraintInterface.hh>
#include <CoMISo/NSolver/NProblemInterface.hh>
#include <CoMISo/NSolver/VariableType.hh>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace {

// The objective of Small.
class SmallProblem : public COMISO::NProblemInterface {
  public:
    std::vector<double> result;

    int n_unknowns() override { return 3; }
    void initial_x(double* x) override { std::fill(x, x + 3, 0.0); }
    double eval_f(const double* x) override {
        return std::pow(x[0] - 0.4, 2) + std::pow(x[1] - 2.7, 2) + std::pow(x[0] - x[1] + x[2], 2);
    }
    void eval_gradient(const double* x, double* gradient) override {
        const double tie = 2.0 * (x[0] - x[1] + x[2]);
        gradient[0] = 2.0 * (x[0] - 0.4) + tie;
        gradient[1] = 2.0 * (x[1] - 2.7) - tie;
        gradient[2] = tie;
    }
    void eval_hessian(const double*, SMatrixNP& hessian) override {
        const double row[] = {1.0, -1.0, 1.0};
        hessian.resize(3, 3);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                hessian.insert(i, j) = 2.0 * row[i] * row[j] + (i == j && i < 2 ? 2.0 : 0.0);
            }
        }
    }
    void store_result(const double* x) override { result.assign(x, x + 3); }
    bool constant_hessian() const override { return true; }
};

// (s x - t)^2 in one unknown.
class Pull {
  public:
    static constexpr int NV = 1;
    static constexpr int NC = 2;
    using VecI = Eigen::Matrix<std::size_t, NV, 1>;
    using VecV = Eigen::Matrix<double, NV, 1>;
    using VecC = Eigen::Matrix<double, NC, 1>;
    using Triplet = Eigen::Triplet<double>;

    double eval_f(const VecV& x, const VecC& c) const { return std::pow(c[0] * x[0] - c[1], 2); }
    void eval_gradient(const VecV& x, const VecC& c, VecV& gradient) const {
        gradient[0] = 2.0 * c[0] * (c[0] * x[0] - c[1]);
    }
    void eval_hessian(const VecV&, const VecC& c, std::vector<Triplet>& triplets) const {
        triplets.emplace_back(0, 0, 2.0 * c[0] * c[0]);
    }
};

// (x - y + z)^2.
class Tie {
  public:
    static constexpr int NV = 3;
    static constexpr int NC = 1;
    using VecI = Eigen::Matrix<std::size_t, NV, 1>;
    using VecV = Eigen::Matrix<double, NV, 1>;
    using VecC = Eigen::Matrix<double, NC, 1>;
    using Triplet = Eigen::Triplet<double>;

    double eval_f(const VecV& x, const VecC&) const { return std::pow(x[0] - x[1] + x[2], 2); }
    void eval_gradient(const VecV& x, const VecC&, VecV& gradient) const {
        gradient = 2.0 * (x[0] - x[1] + x[2]) * VecV(1.0, -1.0, 1.0);
    }
    void eval_hessian(const VecV&, const VecC&, std::vector<Triplet>& triplets) const {
        const double row[] = {1.0, -1.0, 1.0};
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                triplets.emplace_back(i, j, 2.0 * row[i] * row[j]);
            }
        }
    }
};

// The constraint of Small: x0 + 2 x2 - 1.5 = 0.
COMISO::LinearConstraint
row(COMISO::NConstraintInterface::ConstraintType type = COMISO::NConstraintInterface::NC_EQUAL) {
    COMISO::LinearConstraint::SVectorNC coeffs(3);
    coeffs.coeffRef(0) = 1.0;
    coeffs.coeffRef(2) = 2.0;
    return COMISO::LinearConstraint(coeffs, -1.5, type);
}

} // namespace

void functions_give_the_same_as_matrices() {
    const Small small;
    SmallProblem problem;
    COMISO::LinearConstraint constraint = row();
    const double at[] = {1.0, 5.0, 0.5};
    CHECK(constraint.eval_constraint(at) == 0.5 && constraint.is_linear());
    COMISO::NConstraintInterface::SMatrixNC hessian;
    constraint.eval_hessian(at, hessian);
    CHECK(hessian.rows() == 3 && hessian.nonZeros() == 0 && constraint.n_unknowns() == 3);
    CHECK(constraint.coeffs().nonZeros() == 2 && constraint.b() == -1.5);
    CHECK(constraint.constant_gradient() && constraint.constant_hessian());

    std::vector<COMISO::NConstraintInterface*> constraints{&constraint};
    std::vector<COMISO::PairUiV> discrete{{1, COMISO::Integer}, {0, COMISO::Real}};
    COMISO::COMISOSolver solver;
    solver.solve(&problem, constraints, discrete);
    CHECK(near(problem.result, small.best(2.0)));
    solver.solve(&problem, constraints, discrete, 0.0, false, false);
    CHECK(near(problem.result, small.best(2.0)));
    solver.solve(&problem, constraints);
    CHECK(near(problem.result, small.relaxed()));
    solver.solver().misolver().set_direct_rounding();
    solver.solve(&problem, constraints, discrete, 0.0);
    CHECK(near(problem.result, small.best(2.0)));

    const auto refused = [&] {
        try {
            solver.solve(&problem, constraints, discrete);
        } catch (const roundel::Error& error) {
            return error.code() == ROUNDEL_ERROR_NOT_SUPPORTED;
        }
        return false;
    };
    discrete.emplace_back(2, COMISO::Binary);
    CHECK(refused());
    discrete.pop_back();
    for (auto type : {COMISO::NConstraintInterface::NC_LESS_EQUAL,
                      COMISO::NConstraintInterface::NC_GREATER_EQUAL}) {
        constraint = row(type);
        CHECK(refused());
    }
    COMISO::LinearConstraint zero;
    zero.resize(3);
    zero.coeffs().coeffRef(1) = 1.0;
    zero.b() = -2.0;
    CHECK(zero.eval_constraint(at) == 3.0);
    zero.clear();
    CHECK(zero.eval_constraint(at) == 0.0);
}

void elements_sum_up() {
    COMISO::FiniteElementSet<Pull> pulls;
    pulls.instances().add_element(Pull::VecI::Constant(0), Pull::VecC(1.0, 0.4));
    pulls.instances().add_element(Pull::VecI::Constant(1), Pull::VecC(1.0, 2.7));
    COMISO::FiniteElementSet<Tie> ties;
    ties.instances().add_element(Tie::VecI(0, 1, 2), Tie::VecC::Zero());
    COMISO::FiniteElementProblem problem(3);
    problem.add_set(&pulls);
    problem.add_set(&ties);
    SmallProblem same;
    const double at[] = {1.0, 5.0, 0.5};
    CHECK(near(problem.eval_f(at), same.eval_f(at)) && problem.n_unknowns() == 3);

    COMISO::LinearConstraint constraint = row();
    std::vector<COMISO::NConstraintInterface*> constraints{&constraint};
    std::vector<COMISO::PairUiV> discrete{{1, COMISO::Integer}};
    COMISO::COMISOSolver solver;
    solver.solve(&problem, constraints, discrete);
    CHECK(near(problem.x(), Small().best(2.0)));
    double kept[3];
    problem.initial_x(kept);
    CHECK(kept[1] == 2.0);

    pulls.instances().clear_elements();
    CHECK(pulls.instances().size() == 0 && near(problem.eval_f(at), ties.eval_f(at)));
    problem.clear_sets();
    CHECK(problem.eval_f(at) == 0.0);
}
