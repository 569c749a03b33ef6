// Small clients of CoMISo: each file calls the functions of one tier of its interface. The program
// is built with the gmm.h beside this library, with the real GMM++, and with the real one included
// first.

#ifndef ZOO_HPP
#define ZOO_HPP

#include "../../cpp/check.hpp"

#include <gmm/gmm.h>

#include <cmath>
#include <cstddef>
#include <vector>

void a_parametrizer_solves_as_libigl_does();
void a_smooth_field_solves_without_constraints();
void entries_read_and_take_assignments();
void settings_come_back_as_set();
void rounding_types_follow_their_precedence();
void least_squares_and_a_second_solve();
void errors_name_what_is_wrong();
void eigen_matrices_give_the_same();
void a_strategy_is_chosen_by_a_call_or_the_environment();
void functions_give_the_same_as_matrices();
void elements_sum_up();
void a_matrix_is_solved_without_constraints();
void products_are_those_of_dense_matrices();
void copies_and_multiples_are_those_of_dense_matrices();
void columns_visit_their_entries();
void small_entries_are_removed();
void streams_and_mathematics_come_along();

using RowMatrix = gmm::row_matrix<gmm::wsvector<double>>;
using ColMatrix = gmm::col_matrix<gmm::wsvector<double>>;

inline bool near(double a, double b, double tolerance = 1e-9) {
    return std::abs(a - b) <= tolerance;
}

inline bool near(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!near(a[i], b[i])) {
            return false;
        }
    }
    return true;
}

// (x0 - 0.4)^2 + (x1 - 2.7)^2 + (x0 - x1 + x2)^2 subject to x0 + 2 x2 = 1.5, with x1 integer: A, b
// and a row of four numbers. Every kind of rounding gives x1 = 2.
struct Small {
    ColMatrix A{3, 3};
    RowMatrix C{1, 4};
    std::vector<double> b{0.4, 2.7, 0.0};
    std::vector<double> x;
    std::vector<int> integers{1};

    Small() {
        const double row[] = {1.0, -1.0, 1.0};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                A(i, j) += row[i] * row[j];
            }
        }
        A(0, 0) += 1.0;
        A(1, 1) += 1.0;
        C(0, 0) = 1.0;
        C(0, 2) = 2.0;
        C(0, 3) = -1.5;
    }

    // The optimal point for a given x1, with x2 = (rhs - x0) / 2.
    std::vector<double> best(double x1, double rhs = 1.5) const {
        const double x0 = (b[0] + 0.5 * (x1 - 0.5 * rhs)) / 1.25;
        return {x0, x1, 0.5 * (rhs - x0)};
    }
    // The relaxed solution: the x0 of `best` is inserted into x1 - 2.7 = x0 - x1 + x2.
    std::vector<double> relaxed() const {
        double x1 = 0.0;
        for (int k = 0; k < 200; ++k) {
            const auto at = best(x1);
            x1 = 0.5 * (b[1] + at[0] + at[2]);
        }
        return best(x1);
    }
};

#endif
