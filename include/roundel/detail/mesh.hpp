/// Triangle meshes: construction, files, connectivity.

#ifndef ROUNDEL_DETAIL_MESH_HPP
#define ROUNDEL_DETAIL_MESH_HPP

#include <roundel/detail/error.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// The prescribed direction of a face: the angle of one arm of its cross, in radians,
/// counter-clockwise about the normal from the face's first edge.
struct FieldConstraint {
    std::int32_t face;
    double angle;
};

/// A mirror plane of a mesh: the points p with normal . p = offset.
struct MirrorPlane {
    /// Of length 1; it points to the side that is kept.
    std::array<double, 3> normal{};
    double offset = 0;
    /// The largest distance of a mirrored vertex from the surface, as a part of the diagonal of the
    /// bounding box.
    double deviation = 0;
};

/// An oriented triangle mesh, with or without boundary, which does not change after construction.
///
/// Vertices and faces keep their numbers. Local edge k of a face runs from its corner k to its
/// corner k + 1. Edges are numbered in increasing order of (lower face, local edge there). Their
/// first side is the one in the lower face.
class Mesh {
  public:
    /// An empty mesh, which a call returns when it reports a failure in a Status.
    Mesh() noexcept = default;

    /// A mesh of vertices (x, y, z in turn) and faces (three corners each, counter-clockwise seen
    /// from outside).
    Mesh(span<const double> coordinates, span<const std::int32_t> corners,
         Status* status = nullptr) {
        make(roundel_mesh_new, coordinates, corners, status);
    }

    /// The same with 64-bit corners.
    Mesh(span<const double> coordinates, span<const std::int64_t> corners,
         Status* status = nullptr) {
        make(roundel_mesh_new_i64, coordinates, corners, status);
    }

    /// Takes ownership of a mesh of the C interface.
    explicit Mesh(roundel_mesh* owned) noexcept : handle_(owned) {}

    /// A mesh from a file in OBJ, OFF, PLY, STL, glTF or GLB that holds an oriented manifold of
    /// triangles.
    static Mesh read(const std::string& file, Status* status = nullptr) {
        roundel_mesh* made = nullptr;
        detail::check(roundel_mesh_read(file.c_str(), &made), status);
        return Mesh(made);
    }

    /// A mesh from a file in one of these formats that holds any polygons, which are repaired.
    /// Soup::read and repair say what was done.
    static Mesh repaired(const std::string& file, Status* status = nullptr) {
        roundel_soup* soup = nullptr;
        if (!detail::check(roundel_soup_read(file.c_str(), &soup), status)) {
            return {};
        }
        const detail::Handle<roundel_soup, roundel_soup_free> read(soup);
        roundel_repair* repair = nullptr;
        if (!detail::check(roundel_soup_repair(soup, nullptr, &repair), status)) {
            return {};
        }
        const detail::Handle<roundel_repair, roundel_repair_free> done(repair);
        roundel_mesh* made = nullptr;
        detail::check(roundel_repair_mesh(repair, &made), status);
        return Mesh(made);
    }

    /// A procedural shape of about `faces` triangles.
    static Mesh shape(const std::string& name, std::size_t faces, Status* status = nullptr) {
        roundel_mesh* made = nullptr;
        detail::check(roundel_mesh_make_shape(name.c_str(), faces, &made), status);
        return Mesh(made);
    }

    /// A copy whose vertices are moved by reproducible noise, of `amplitude` times their shortest
    /// edge.
    Mesh jittered(double amplitude, std::int64_t seed, Status* status = nullptr) const {
        roundel_mesh* made = nullptr;
        detail::check(roundel_mesh_jitter(get(), amplitude, seed, &made), status);
        return Mesh(made);
    }

    /// Writes an OBJ, OFF, PLY, STL, glTF, GLB or USD text file.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_mesh_write(get(), file.c_str()), status);
    }

    /// Whether the mesh is not empty.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    std::size_t vertices(Status* status = nullptr) const {
        return number<std::size_t>(roundel_mesh_vertex_count, status);
    }
    std::size_t edges(Status* status = nullptr) const {
        return number<std::size_t>(roundel_mesh_edge_count, status);
    }
    std::size_t faces(Status* status = nullptr) const {
        return number<std::size_t>(roundel_mesh_face_count, status);
    }
    std::size_t boundary_loops(Status* status = nullptr) const {
        return number<std::size_t>(roundel_mesh_boundary_loop_count, status);
    }
    std::int64_t euler_characteristic(Status* status = nullptr) const {
        return number<std::int64_t>(roundel_mesh_euler_characteristic, status);
    }

    /// The mirror plane that a text means, as QuadOptions::mirror takes it.
    MirrorPlane mirror_plane(const std::string& mirror = "auto", Status* status = nullptr) const {
        MirrorPlane found;
        std::array<double, 4> plane{};
        const auto code =
            roundel_mesh_mirror_plane(get(), mirror.c_str(), plane.data(), &found.deviation);
        if (detail::check(code, status)) {
            found.normal = {plane[0], plane[1], plane[2]};
            found.offset = plane[3];
        }
        return found;
    }
    /// x, y, z of every vertex.
    std::vector<double> coordinates(Status* status = nullptr) const {
        return copied<double>(roundel_mesh_coordinates, 3 * vertices(status), status);
    }
    /// The three corners of every face.
    std::vector<std::int32_t> corners(Status* status = nullptr) const {
        return copied<std::int32_t>(roundel_mesh_corners, 3 * faces(status), status);
    }
    /// The two faces of every edge; the second is -1 at the boundary.
    std::vector<std::int32_t> edge_faces(Status* status = nullptr) const {
        return copied<std::int32_t>(roundel_mesh_edge_faces, 2 * edges(status), status);
    }
    /// The three edges of every face.
    std::vector<std::int32_t> face_edges(Status* status = nullptr) const {
        return copied<std::int32_t>(roundel_mesh_face_edges, 3 * faces(status), status);
    }

    /// Directions from the curvature of the surface for a `fraction` of the faces: those where the
    /// direction of least absolute curvature is most reliable, in increasing order.
    std::vector<FieldConstraint> curvature_constraints(double fraction,
                                                       Status* status = nullptr) const {
        std::vector<std::int32_t> face(faces(status));
        std::vector<double> angle(face.size());
        std::size_t count = 0;
        detail::check(roundel_mesh_curvature_constraints(get(), fraction, face.size(), face.data(),
                                                         angle.data(), &count),
                      status);
        std::vector<FieldConstraint> found(count);
        for (std::size_t i = 0; i < count; ++i) {
            found[i] = {face[i], angle[i]};
        }
        return found;
    }

    /// The handle for calls of the C interface.
    const roundel_mesh* get() const noexcept { return handle_.get(); }

  private:
    template <class Function, class Index>
    void make(Function function, span<const double> coordinates, span<const Index> corners,
              Status* status) {
        if (coordinates.size() % 3 != 0 || corners.size() % 3 != 0) {
            Status failure;
            failure.code = ROUNDEL_ERROR_LENGTH_MISMATCH;
            failure.message = "coordinates and corners come in threes";
            detail::fail(std::move(failure), status);
            return;
        }
        roundel_mesh* made = nullptr;
        detail::check(function(coordinates.size() / 3, coordinates.data(), corners.size() / 3,
                               corners.data(), &made),
                      status);
        handle_.reset(made);
    }

    template <class Number, class Function> Number number(Function function, Status* status) const {
        Number value = 0;
        detail::check(function(get(), &value), status);
        return value;
    }

    template <class Number, class Function>
    std::vector<Number> copied(Function function, std::size_t length, Status* status) const {
        std::vector<Number> values(length);
        detail::check(function(get(), values.data(), length), status);
        return values;
    }

    detail::Handle<roundel_mesh, roundel_mesh_free> handle_;
};

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_MESH_HPP
