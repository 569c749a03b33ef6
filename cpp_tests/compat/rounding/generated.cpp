// Rounding through CoMISo's interface on seamless parametrizations of procedural shapes.
//
// usage: generated SCRATCH.mps

#include "solve.hpp"

#include <string>

namespace {

roundel::Problem map_of(const std::string& shape, std::size_t triangles) {
    const auto mesh = roundel::Mesh::shape(shape, triangles);
    const auto field = roundel::orientation_field(mesh);
    roundel_map* map = nullptr;
    roundel_problem* problem = nullptr;
    CHECK(roundel_map_new(mesh.get(), field.get(), nullptr, &map) == ROUNDEL_OK);
    CHECK(roundel_map_set_quads(map, 120) == ROUNDEL_OK);
    CHECK(roundel_map_make_problem(map, &problem) == ROUNDEL_OK);
    CHECK(roundel_map_free(map) == ROUNDEL_OK);
    return roundel::Problem(problem);
}

} // namespace

int main(int, char** arguments) {
    for (const char* shape : {"rounded-cube", "genus-2", "gear"}) {
        const GmmProblem problem = in_gmm(map_of(shape, 400), arguments[1]);
        const Solved multiple = by_thesis(problem);
        const Solved standard = by(problem, "");
        const Solved best = by(problem, "auto");
        const Solved relaxed = by(problem, "relax");
        std::printf("%s: %zu integers, thesis %g, defaults %g, auto %g, relaxation %g\n", shape,
                    problem.integers.size(), multiple.energy, standard.energy, best.energy,
                    relaxed.energy);
        for (const Solved* solution : {&multiple, &standard, &best}) {
            CHECK(problem.violation(solution->x) < 1e-6);
            CHECK(solution->energy >= best.energy - 1e-6);
            CHECK(solution->energy >= relaxed.energy - 1e-6);
        }
        CHECK(multiple.energy <= by(problem, "direct").energy + 1e-6);

        // The environment variable changes the strategy of a program that sets none.
        setenv("ROUNDEL_COMISO_STRATEGY", "auto", 1);
        CHECK(by_thesis(problem).x == best.x);
        unsetenv("ROUNDEL_COMISO_STRATEGY");
        CHECK(by_thesis(problem).x == multiple.x);
    }
    return failures != 0;
}
