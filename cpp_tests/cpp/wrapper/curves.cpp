// Curves on a surface: guides and edges.

#include "wrapper.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

void curves_guide_a_field_and_become_edges() {
    const auto plane = roundel::Mesh::shape("plane", 800);
    const std::vector<double> line{-0.71, -0.52, 0.0, 0.63, 0.48, 0.0};
    roundel::Curves curves;
    curves.draw(plane, line);
    CHECK(curves.size() == 1);
    const auto guides = curves.guides(plane);
    CHECK(guides.size() > 20);
    roundel::FieldOptions follow;
    follow.set_guides(guides).set_features(roundel::no_features());
    const auto field = roundel::orientation_field(plane, follow);
    for (const auto& guide : guides) {
        const double off = field.angles()[static_cast<std::size_t>(guide.face)] - guide.angle;
        const double quarters = off / 1.57079632679489662;
        CHECK(std::fabs(quarters - std::round(quarters)) < 1e-3);
    }
    const auto cut = roundel::cut_along(plane, curves);
    CHECK(cut.mesh.vertices() > plane.vertices() && cut.edges.size() > 20);
    CHECK(cut.face_origins.size() == cut.mesh.faces());
    roundel::Status status;
    const std::vector<double> far{0.0, 0.0, 0.0, 0.5, 0.0, 9.0};
    curves.draw(plane, far, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT && status.index == 1);
    const std::vector<roundel::SurfacePoint> apart{{0, {1.0, 0.0, 0.0}}, {700, {1.0, 0.0, 0.0}}};
    curves.add(apart);
    CHECK(!roundel::cut_along(plane, curves, &status).mesh && status.index == 1);
    CHECK(curves.guides(plane, 1.0, 4, &status).empty());
}
