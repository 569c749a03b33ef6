// The README's problem, written as a program for CoMISo.

#include <gmm/gmm.h>

#include <CoMISo/Solver/ConstrainedSolver.hh>

#include <iostream>
#include <vector>

int main() {
    gmm::col_matrix<gmm::wsvector<double>> A(2, 2);
    gmm::row_matrix<gmm::wsvector<double>> C(0, 3);
    A(0, 0) += 2.0;
    A(1, 1) += 1.0;
    A(0, 1) -= 1.0;
    A(1, 0) -= 1.0;
    std::vector<double> b{0.4, 0.0};
    std::vector<double> x;
    std::vector<int> integers{1};
    COMISO::ConstrainedSolver solver;
    solver.solve(C, A, x, b, integers, 0.0, false, false);
    std::cout << x[0] << ' ' << x[1] << '\n';
}
