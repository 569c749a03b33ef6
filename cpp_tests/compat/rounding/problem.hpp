// A problem in the matrices that programs pass to CoMISo.

#ifndef ROUNDING_PROBLEM_HPP
#define ROUNDING_PROBLEM_HPP

#include <gmm/gmm.h>

#include <roundel/roundel.hpp>

#include <string>
#include <vector>

// x'Ax - 2 x'b + constant, subject to rows c . x + c_{n+1} = 0, with some unknowns integer.
struct GmmProblem {
    gmm::col_matrix<gmm::wsvector<double>> A;
    gmm::row_matrix<gmm::wsvector<double>> C;
    std::vector<double> b;
    std::vector<int> integers;
    double constant = 0.0;

    // The energy at x, computed from the matrices alone.
    double energy(const std::vector<double>& x) const;
    double violation(const std::vector<double>& x) const;
};

// Converts any problem of the library by way of a file, which it writes to `scratch`.
GmmProblem in_gmm(const roundel::Problem& problem, const std::string& scratch);

#endif
