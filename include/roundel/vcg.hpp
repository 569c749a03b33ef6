/// Roundel for VCGlib: fields, maps and quads of its meshes, with results in its components.
///
///     auto field = roundel::orientation_field(mesh, {.constrain_curvature = 0.1});
///     auto p = roundel::store(field, mesh);
///     for (auto& face : mesh.face) std::cout << p.angle[face] << '\n';
///     auto map = roundel::parametrize(mesh, field, {.quads = 2000});
///     roundel::store(map, mesh);                        // wedge texture coordinates
///     PolyMesh quads;
///     roundel::store(roundel::quadrangulate(mesh), quads);
///
/// For every type of triangle mesh that is a vcg::tri::TriMesh. Elements marked as deleted are
/// skipped, so no compacting is needed. The first edge of a face is its edge 0. This header
/// includes nothing of VCGlib: include the headers of your mesh type before it.

#ifndef ROUNDEL_VCG_HPP
#define ROUNDEL_VCG_HPP

#include <roundel/detail/adapted.hpp>
#include <roundel/roundel.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace vcg {
namespace tri {
template <class MeshType> class Allocator;
} // namespace tri
} // namespace vcg

ROUNDEL_NAMESPACE_BEGIN

namespace vcglib {

/// A side of a face, as in vcg::face::Pos: the number of the face in `mesh.face`, and its edge 0
/// to 2.
struct Side {
    std::size_t face;
    int edge;
};

/// Vertices and faces are given by their numbers in `mesh.vert` and `mesh.face`, which stay valid
/// when the mesh's arrays move.
using Elements = Adapted<std::size_t, std::size_t, Side>;
using Field = AdaptedField<std::size_t, std::size_t, Side>;
using Map = AdaptedMap<std::size_t, std::size_t, Side>;

template <class M>
using enable = std::enable_if_t<
    sizeof(typename M::VertContainer) != 0 && sizeof(typename M::FaceContainer) != 0, int>;

/// The attributes of a field on a mesh, under the names "roundel:angle", "roundel:period_jump",
/// "roundel:kappa" and "roundel:index".
template <class M> struct Properties {
    /// The angle of one arm of the face's cross, from its edge 0.
    typename M::template PerFaceAttributeHandle<double> angle;
    /// For face f and the face g over each of its edges, the arm of g with angle + kappa + pi/2
    /// jump matches the arm of f. Zero at the boundary.
    typename M::template PerFaceAttributeHandle<std::array<std::int32_t, 3>> period_jump;
    /// The angle of the frame of the face in that of the face over each of its edges.
    typename M::template PerFaceAttributeHandle<std::array<double, 3>> kappa;
    /// The index in full turns; zero at the boundary.
    typename M::template PerVertexAttributeHandle<double> index;
};

} // namespace vcglib

/// The triangles of a VCG mesh that are not deleted.
template <class M, vcglib::enable<M> = 0>
vcglib::Elements adapt(const M& mesh, Status* status = nullptr) {
    vcglib::Elements elements;
    detail::Soup soup;
    std::vector<std::int64_t> number(mesh.vert.size(), -1);
    for (std::size_t v = 0; v < mesh.vert.size(); ++v) {
        if (mesh.vert[v].IsD()) {
            continue;
        }
        number[v] = static_cast<std::int64_t>(elements.vertices.size());
        elements.vertices.push_back(v);
        const auto& point = mesh.vert[v].cP();
        for (int axis = 0; axis < 3; ++axis) {
            soup.coordinates.push_back(static_cast<double>(point[axis]));
        }
    }
    for (std::size_t f = 0; f < mesh.face.size(); ++f) {
        const auto& face = mesh.face[f];
        if (face.IsD()) {
            continue;
        }
        if (face.VN() != 3) {
            detail::not_a_triangle(elements.faces.size(), status);
            return {};
        }
        for (int k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(face.cV(k) - mesh.vert.data());
            soup.corners.push_back(number[vertex]);
            elements.halfedges.push_back({f, k});
        }
        elements.faces.push_back(f);
    }
    elements.mesh = soup.mesh(status);
    return elements;
}

/// The smoothest field of a VCG mesh that satisfies the constraints. Their faces are numbered
/// without the deleted ones.
template <class M, vcglib::enable<M> = 0>
vcglib::Field orientation_field(const M& mesh, const FieldOptions& options = {},
                                Status* status = nullptr) {
    return detail::field_of(adapt(mesh, status), options, status);
}

namespace detail {

/// For every side of `mesh.face` the opposite side: the same edge in the neighbouring face, or the
/// side itself at the boundary.
inline std::vector<std::array<vcglib::Side, 3>> opposites(const vcglib::Elements& elements) {
    const auto& sides = elements.halfedges;
    const auto edges = elements.mesh.face_edges();
    const std::size_t faces = elements.faces.empty() ? 0 : elements.faces.back() + 1;
    std::vector<std::array<vcglib::Side, 3>> over(faces);
    std::vector<vcglib::Side> first;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const vcglib::Side here = sides[i];
        const auto edge = static_cast<std::size_t>(edges[i]);
        // Edges are numbered in the order of their first sides.
        if (edge == first.size()) {
            first.push_back(here);
        }
        const vcglib::Side there = first[edge];
        over[here.face][static_cast<std::size_t>(here.edge)] = there;
        over[there.face][static_cast<std::size_t>(there.edge)] = here;
    }
    return over;
}

/// Sets a face's PD1 to the direction at `angle` from its edge 0, and PD2 to the one a quarter
/// further.
template <class F> void set_directions(F& face, double angle) {
    using Scalar = typename std::decay_t<decltype(face.PD1())>::ScalarType;
    const auto arrow = [&](int end) {
        std::array<double, 3> d{};
        for (int axis = 0; axis < 3; ++axis) {
            d[static_cast<std::size_t>(axis)] = static_cast<double>(face.cV(end)->cP()[axis]) -
                                                static_cast<double>(face.cV(0)->cP()[axis]);
        }
        return d;
    };
    const auto dot = [](const auto& a, const auto& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    // One axis along the edge, the other across it towards the face.
    auto x = arrow(1), y = arrow(2);
    const double along = dot(x, y) / dot(x, x);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        y[axis] -= along * x[axis];
    }
    const double width = std::sqrt(dot(x, x)), height = std::sqrt(dot(y, y));
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double along_x = x[i] / width, along_y = y[i] / height;
        face.PD1()[axis] =
            static_cast<Scalar>(std::cos(angle) * along_x + std::sin(angle) * along_y);
        face.PD2()[axis] =
            static_cast<Scalar>(std::cos(angle) * along_y - std::sin(angle) * along_x);
    }
}

} // namespace detail

/// Writes a field to attributes of the mesh that it was computed on. Attributes that do not exist
/// are added. If the faces have directions PD1 and PD2, where VCG keeps crosses, these are set too.
template <class M, vcglib::enable<M> = 0>
vcglib::Properties<M> store(const vcglib::Field& field, M& mesh) {
    using Allocator = ::vcg::tri::Allocator<M>;
    using Jumps = std::array<std::int32_t, 3>;
    using Turns = std::array<double, 3>;
    vcglib::Properties<M> to;
    to.angle = Allocator::template GetPerFaceAttribute<double>(mesh, "roundel:angle");
    to.period_jump = Allocator::template GetPerFaceAttribute<Jumps>(mesh, "roundel:period_jump");
    to.kappa = Allocator::template GetPerFaceAttribute<Turns>(mesh, "roundel:kappa");
    to.index = Allocator::template GetPerVertexAttribute<double>(mesh, "roundel:index");
    // Found by argument-dependent lookup; false for types that cannot hold directions.
    const bool has_directions = HasPerFaceCurvatureDir(mesh);
    const auto over = detail::opposites(field.elements());
    const auto opposite = [&](vcglib::Side side) {
        return over[side.face][static_cast<std::size_t>(side.edge)];
    };
    detail::hand_out(
        field, opposite,
        [&](std::size_t f, double angle) {
            to.angle[f] = angle;
            if (has_directions) {
                detail::set_directions(mesh.face[f], angle);
            }
        },
        [&](std::size_t v, double index) { to.index[v] = index; },
        [&](vcglib::Side side, std::int32_t jump, double kappa) {
            to.period_jump[side.face][static_cast<std::size_t>(side.edge)] = jump;
            to.kappa[side.face][static_cast<std::size_t>(side.edge)] = kappa;
        });
    return to;
}

/// The seamless map of a VCG mesh that follows a field computed on it.
template <class M, vcglib::enable<M> = 0>
vcglib::Map parametrize(const M& mesh, const vcglib::Field& field, const MapOptions& options = {},
                        Status* status = nullptr) {
    return detail::map_of(adapt(mesh, status), field, options, status);
}

/// Writes a map to the wedge texture coordinates of the mesh that it was computed on: u and v of
/// each corner of each face, in texture 0. Fails with ROUNDEL_ERROR_INVALID_ARGUMENT for a mesh
/// whose faces have no wedge texture coordinates or have them disabled.
template <class M, vcglib::enable<M> = 0>
void store(const vcglib::Map& map, M& mesh, Status* status = nullptr) {
    if (!HasPerWedgeTexCoord(mesh)) {
        Status failure;
        failure.code = ROUNDEL_ERROR_INVALID_ARGUMENT;
        failure.message = "the mesh's faces have no wedge texture coordinates";
        return detail::fail(std::move(failure), status);
    }
    using Scalar = typename M::FaceType::TexCoordType::ScalarType;
    const auto uv = map.corner_uvs();
    const auto& faces = map.elements().faces;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            auto& corner = mesh.face[faces[i]].WT(k);
            const std::size_t at = 6 * i + 2 * static_cast<std::size_t>(k);
            corner.U() = static_cast<Scalar>(uv[at]);
            corner.V() = static_cast<Scalar>(uv[at + 1]);
            corner.N() = 0;
        }
    }
}

/// Quadrangulates a VCG mesh. `roundel::store` writes the result to a mesh.
template <class M, vcglib::enable<M> = 0>
Quads quadrangulate(const M& mesh, const QuadOptions& options = {}, Status* status = nullptr) {
    const auto elements = adapt(mesh, status);
    return elements ? quadrangulate(elements.mesh, options, status) : Quads();
}

/// Adds the quads, and the faces that are not quads, to a mesh, because VCG's meshes cannot be
/// returned. A mesh type whose faces have PolyInfo gets polygons. Other mesh types get triangles
/// whose inner edges are marked as faux, which is how VCG represents polygons by triangles.
template <class M, vcglib::enable<M> = 0> void store(const Quads& quads, M& mesh) {
    using Allocator = ::vcg::tri::Allocator<M>;
    using Scalar = typename M::ScalarType;
    const auto polygons = detail::polygons(quads);
    const auto at = quads.vertices();
    const bool whole = M::FaceType::HasPolyInfo();
    std::size_t total = 0;
    for (const auto& polygon : polygons) {
        total += whole ? 1 : polygon.size() - 2;
    }
    const std::size_t first = mesh.vert.size();
    Allocator::AddVertices(mesh, at.size() / 3);
    for (std::size_t i = 0; i < at.size(); ++i) {
        mesh.vert[first + i / 3].P()[static_cast<int>(i % 3)] = static_cast<Scalar>(at[i]);
    }
    auto face = mesh.face.size();
    Allocator::AddFaces(mesh, total);
    const auto corner = [&](std::size_t k, std::int32_t vertex) {
        mesh.face[face].V(static_cast<int>(k)) =
            &mesh.vert[first + static_cast<std::size_t>(vertex)];
    };
    for (const auto& polygon : polygons) {
        if (whole) {
            mesh.face[face].Alloc(static_cast<int>(polygon.size()));
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                corner(k, polygon[k]);
            }
            ++face;
            continue;
        }
        // A fan around the first corner.
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k, ++face) {
            corner(0, polygon[0]);
            corner(1, polygon[k]);
            corner(2, polygon[k + 1]);
            if (k != 1) {
                mesh.face[face].SetF(0);
            }
            if (k + 2 != polygon.size()) {
                mesh.face[face].SetF(2);
            }
        }
    }
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_VCG_HPP
