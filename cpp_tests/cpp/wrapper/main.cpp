// Runs the groups of checks of the C++ layer.

#include "wrapper.hpp"

roundel::Problem chain(std::int32_t n) {
    roundel::Problem problem(static_cast<std::size_t>(n));
    problem.least_squares({0}, {1.0}, 0.2);
    for (std::int32_t i = 0; i + 1 < n; ++i) {
        problem.least_squares({i + 1, i}, {1.0, -1.0}, 0.3);
        if (i % 2 == 0) {
            problem.integer({i + 1});
        }
    }
    return problem;
}

int main() {
    ownership_moves_and_does_not_copy();
    every_part_of_a_problem_counts();
    rows_given_together_are_rows_given_one_by_one();
    rows_and_bounds_limit_a_problem();
    rows_come_during_a_solve();
    files_may_maximise();
    proofs_are_written_and_checked();
    failures_throw_or_are_reported();
    options_follow_the_librarys_list();
    callbacks_stop_and_throw();
    tokens_cancel_from_other_threads();
    threads_share_a_problem_and_keep_their_errors();
    files_keep_the_problem();
    a_solver_gives_the_same_as_a_solve();
    fields_follow_their_options();
    maps_are_solved_again_at_another_size();
    unset_quad_options_have_the_librarys_defaults();
    labels_and_numbers_come_to_quads();
    meshes_become_quads_of_their_topology();
    quads_are_mirrored();
    soups_become_meshes_and_say_how();
    repair_follows_its_options();
    attributes_come_from_the_file_of_a_mesh();
    files_of_polygons_become_meshes();
    edges_between_materials_are_told();
    distances_follow_the_surface();
    the_boundary_points_and_edges_are_sources();
    curves_guide_a_field_and_become_edges();
    quads_follow_a_layout();
    return failures != 0;
}
