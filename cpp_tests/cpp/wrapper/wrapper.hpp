// The groups of checks of the C++ layer, built as C++17 and as C++20.

#ifndef WRAPPER_HPP
#define WRAPPER_HPP

#include "../check.hpp"

#include <roundel/roundel.hpp>

void ownership_moves_and_does_not_copy();
void every_part_of_a_problem_counts();
void rows_given_together_are_rows_given_one_by_one();
void rows_and_bounds_limit_a_problem();
void rows_come_during_a_solve();
void files_may_maximise();
void proofs_are_written_and_checked();
void failures_throw_or_are_reported();
void options_follow_the_librarys_list();
void callbacks_stop_and_throw();
void tokens_cancel_from_other_threads();
void threads_share_a_problem_and_keep_their_errors();
void files_keep_the_problem();
void a_solver_gives_the_same_as_a_solve();
void fields_follow_their_options();
void maps_are_solved_again_at_another_size();
void labels_and_numbers_come_to_quads();
void meshes_become_quads_of_their_topology();
void quads_are_mirrored();
void unset_quad_options_have_the_librarys_defaults();
void soups_become_meshes_and_say_how();
void repair_follows_its_options();
void attributes_come_from_the_file_of_a_mesh();
void files_of_polygons_become_meshes();
void edges_between_materials_are_told();
void distances_follow_the_surface();
void the_boundary_points_and_edges_are_sources();
void curves_guide_a_field_and_become_edges();
void quads_follow_a_layout();

/// A chain of `n` variables with target differences of 0.3, in which every second one is an
/// integer.
roundel::Problem chain(std::int32_t n);

#endif
