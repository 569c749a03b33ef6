// Eigen's matrices in place of GMM's.

#include "zoo.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <CoMISo/Solver/ConstrainedSolver.hh>

void eigen_matrices_give_the_same() {
    const Small small;
    Eigen::SparseMatrix<double> A(3, 3);
    Eigen::SparseMatrix<double, Eigen::RowMajor> C(1, 4);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            A.coeffRef(i, j) = small.A(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
        }
    }
    for (int j = 0; j < 4; ++j) {
        C.coeffRef(0, j) = small.C(0, static_cast<std::size_t>(j));
    }
    Eigen::VectorXd b(3);
    b << 0.4, 2.7, 0.0;
    Eigen::VectorXd x;
    std::vector<int> integers{1};
    const auto expect = [&](const std::vector<double>& expected) {
        CHECK(x.size() == 3 && near(std::vector<double>(x.data(), x.data() + 3), expected));
    };
    COMISO::ConstrainedSolver solver;
    solver.solve(C, A, x, b, integers, 0.0, false, false);
    expect(small.best(2.0));
    solver.solve_const(C, A, x, b, integers);
    expect(small.best(2.0));
    Eigen::VectorXd constraint(1);
    constraint << 0.5;
    solver.resolve(x, constraint, b);
    expect(small.best(2.0, 0.5));

    Eigen::SparseMatrix<double, Eigen::RowMajor> B(3, 4);
    B.coeffRef(0, 0) = 1.0;
    B.coeffRef(0, 3) = -0.4;
    B.coeffRef(1, 1) = 1.0;
    B.coeffRef(1, 3) = -2.7;
    B.coeffRef(2, 0) = 1.0;
    B.coeffRef(2, 1) = -1.0;
    B.coeffRef(2, 2) = 1.0;
    solver.solve(C, B, x, integers);
    expect(small.best(2.0));
    solver.solve_const(C, B, x, integers);
    expect(small.best(2.0));
}
