// Runs the groups of checks on CoMISo's interface.

#include "zoo.hpp"

int main() {
    a_parametrizer_solves_as_libigl_does();
    a_smooth_field_solves_without_constraints();
    entries_read_and_take_assignments();
    settings_come_back_as_set();
    rounding_types_follow_their_precedence();
    least_squares_and_a_second_solve();
    errors_name_what_is_wrong();
    eigen_matrices_give_the_same();
    a_strategy_is_chosen_by_a_call_or_the_environment();
    functions_give_the_same_as_matrices();
    elements_sum_up();
    a_matrix_is_solved_without_constraints();
    products_are_those_of_dense_matrices();
    copies_and_multiples_are_those_of_dense_matrices();
    columns_visit_their_entries();
    small_entries_are_removed();
    streams_and_mathematics_come_along();
    return failures != 0;
}
