/// Roundel for C++17 and later: a header-only layer over the C interface.
///
///     roundel::Problem problem(3);
///     problem.least_squares({0, 1}, {1.0, -1.0}, 0.4);   // (x0 - x1 - 0.4)^2
///     problem.constrain({0, 2}, {1.0, -1.0}, 0.0);       // x0 = x2
///     problem.integer({1});
///     auto solution = roundel::solve(problem, {.strategy = "greedy"});   // C++20
///     for (double x : solution.values()) ...
///
///     auto mesh = roundel::Mesh::read("rocker-arm.obj");
///     auto field = roundel::orientation_field(mesh, {.constrain_curvature = 0.1});
///     roundel::quadrangulate(mesh, {.quads = 2000}).write("quads.obj");
///     auto map = roundel::parametrize(mesh, field, {.quads = 2000});
///
///     auto repair = roundel::repair(roundel::Soup::read("part.stl"));    // any polygons
///     std::cout << repair.summary();
///     roundel::quadrangulate(repair.mesh());
///
/// In C++17: `roundel::Options options; options.set_strategy("greedy");`.
///
/// Errors. A call that fails throws roundel::Error, which names the element at fault. Every call
/// also takes a `Status*` as its last argument. With a Status it throws nothing and reports the
/// failure there. Built without exceptions, a failure without a Status ends the program.
///
/// Problem, Solution, Solver, Mesh, Soup, Repair, Sources, GeodesicDistance, Curves,
/// Field, Map, Quads, BaseLayout and
/// CancelToken own their C objects. They can be moved and not copied. A const object may be used by
/// several threads at once, any other by one.
///
/// Adapters for meshes of other libraries: <roundel/openmesh.hpp>, <roundel/cgal.hpp>,
/// <roundel/eigen.hpp>, <roundel/vcg.hpp>.

#ifndef ROUNDEL_HPP
#define ROUNDEL_HPP

#include <roundel/detail/attributes.hpp>
#include <roundel/detail/curves.hpp>
#include <roundel/detail/error.hpp>
#include <roundel/detail/features.hpp>
#include <roundel/detail/field.hpp>
#include <roundel/detail/geodesic.hpp>
#include <roundel/detail/layouts.hpp>
#include <roundel/detail/lazy_rows.hpp>
#include <roundel/detail/map.hpp>
#include <roundel/detail/mesh.hpp>
#include <roundel/detail/options.hpp>
#include <roundel/detail/problem.hpp>
#include <roundel/detail/proof.hpp>
#include <roundel/detail/quad_meshes.hpp>
#include <roundel/detail/quads.hpp>
#include <roundel/detail/repair.hpp>
#include <roundel/detail/solution.hpp>
#include <roundel/detail/solve.hpp>
#include <roundel/detail/solver.hpp>
#include <roundel/detail/span.hpp>
#include <roundel/roundel.h>

#endif // ROUNDEL_HPP
