/// Curves on a surface: as guides of a field, and as edges of a mesh that is cut along them.

#ifndef ROUNDEL_DETAIL_CURVES_HPP
#define ROUNDEL_DETAIL_CURVES_HPP

#include <roundel/detail/field.hpp>
#include <roundel/detail/geodesic.hpp>
#include <roundel/detail/mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// Curves on the surface of a mesh, numbered from 0 as they are added.
class Curves {
  public:
    explicit Curves(Status* status = nullptr) {
        roundel_curves* made = nullptr;
        detail::check(roundel_curves_new(&made), status);
        handle_.reset(made);
    }

    /// Draws a polyline in space, x, y, z in turn, onto a mesh: through closest points, along
    /// shortest paths. It is closed if the last point is the first. A point that is too far from
    /// the surface is a failure, whose index is the number of the point.
    Curves& draw(const Mesh& mesh, span<const double> points, Status* status = nullptr) {
        detail::check(roundel_curves_draw(handle_.get(), mesh.get(), points.size() / 3,
                                          points.data(), nullptr),
                      status);
        return *this;
    }

    /// Adds a curve through points of the surface. Points that follow each other lie on a common
    /// face.
    Curves& add(span<const SurfacePoint> points, Status* status = nullptr) {
        const detail::PointArrays arrays(points);
        detail::check(roundel_curves_add(handle_.get(), points.size(), arrays.faces.data(),
                                         arrays.barycentric.data()),
                      status);
        return *this;
    }

    /// The number of curves.
    std::size_t size(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_curves_count(handle_.get(), &count), status);
        return count;
    }

    /// Guides for all faces that curves pass, for FieldOptions::guides of this symmetry. The weight
    /// of a face is `weight` times the length of the curves inside it over the square root of its
    /// area.
    std::vector<FieldGuide> guides(const Mesh& mesh, double weight = 10.0,
                                   std::int32_t symmetry = 4, Status* status = nullptr) const {
        std::size_t count = 0;
        std::vector<std::int32_t> faces;
        std::vector<double> angles;
        std::vector<double> weights;
        const auto ask = [&](std::size_t room) {
            return detail::check(roundel_curves_guides(get(), mesh.get(), symmetry, weight, room,
                                                       faces.data(), angles.data(), weights.data(),
                                                       &count),
                                 status);
        };
        if (!ask(0) || count == 0) {
            return {};
        }
        faces.resize(count);
        angles.resize(count);
        weights.resize(count);
        std::vector<FieldGuide> found;
        if (ask(count)) {
            for (std::size_t i = 0; i < count; ++i) {
                found.push_back({faces[i], angles[i], weights[i]});
            }
        }
        return found;
    }

    /// The handle for calls of the C interface.
    const roundel_curves* get() const noexcept { return handle_.get(); }

  private:
    detail::Handle<roundel_curves, roundel_curves_free> handle_;
};

/// A mesh that was cut along curves. Its first vertices are those of the mesh that was given.
struct Cut {
    Mesh mesh{};
    /// The face of the given mesh of which each face is a part.
    std::vector<std::int32_t> face_origins{};
    /// The edges along curves. They may be Features::edges.
    std::vector<std::int32_t> edges{};
};

/// Cuts the faces of a mesh along curves, so that they are chains of edges. Curves that are not on
/// the mesh are failures, whose index is the number of the curve.
inline Cut cut_along(const Mesh& mesh, const Curves& curves, Status* status = nullptr) {
    roundel_cut* made = nullptr;
    Cut found;
    if (!detail::check(roundel_cut_new(mesh.get(), curves.get(), &made), status)) {
        return found;
    }
    const detail::Handle<roundel_cut, roundel_cut_free> handle(made);
    roundel_mesh* cut = nullptr;
    if (!detail::check(roundel_cut_mesh(made, &cut), status)) {
        return found;
    }
    found.mesh = Mesh(cut);
    found.face_origins.resize(found.mesh.faces(status));
    std::vector<std::int32_t> marks(found.mesh.edges(status));
    if (detail::check(
            roundel_cut_face_origins(made, found.face_origins.data(), found.face_origins.size()),
            status) &&
        detail::check(roundel_cut_mark_curves(made, marks.data(), marks.size()), status)) {
        for (std::size_t edge = 0; edge < marks.size(); ++edge) {
            if (marks[edge] != 0) {
                found.edges.push_back(static_cast<std::int32_t>(edge));
            }
        }
    }
    return found;
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_CURVES_HPP
