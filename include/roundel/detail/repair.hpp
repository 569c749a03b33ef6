/// Polygon soups, and the meshes that repair makes of them.

#ifndef ROUNDEL_DETAIL_REPAIR_HPP
#define ROUNDEL_DETAIL_REPAIR_HPP

#include <roundel/detail/mesh.hpp>
#include <roundel/detail/options.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A polygon soup: vertices, and polygons with any number of corners, of which nothing is assumed.
/// It does not change after construction.
class Soup {
  public:
    /// An empty soup, which a call returns when it reports a failure in a Status.
    Soup() noexcept = default;

    /// A soup of vertices (x, y, z in turn) and polygons: the number of corners of each, and the
    /// corners of all, one polygon after the other. Corners that name no vertex are kept.
    Soup(span<const double> coordinates, span<const std::int32_t> sizes,
         span<const std::int32_t> corners, Status* status = nullptr) {
        make(roundel_soup_new, coordinates, sizes, corners, status);
    }

    /// The same with 64-bit corners.
    Soup(span<const double> coordinates, span<const std::int32_t> sizes,
         span<const std::int64_t> corners, Status* status = nullptr) {
        make(roundel_soup_new_i64, coordinates, sizes, corners, status);
    }

    /// Takes ownership of a soup of the C interface.
    explicit Soup(roundel_soup* owned) noexcept : handle_(owned) {}

    /// A soup from a file in OBJ, OFF, PLY, STL, glTF or GLB.
    static Soup read(const std::string& file, Status* status = nullptr) {
        roundel_soup* made = nullptr;
        detail::check(roundel_soup_read(file.c_str(), &made), status);
        return Soup(made);
    }

    /// A soup from a file of any name, whose format is "obj", "off", "ply", "stl", "gltf" or "glb".
    static Soup read_as(const std::string& file, const std::string& format,
                        Status* status = nullptr) {
        roundel_soup* made = nullptr;
        detail::check(roundel_soup_read_as(file.c_str(), format.c_str(), &made), status);
        return Soup(made);
    }

    /// Whether there is a soup, which may have no polygons.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    std::size_t vertices(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_soup_vertex_count(get(), &count), status);
        return count;
    }
    std::size_t polygons(Status* status = nullptr) const { return counts(status).first; }

    /// x, y, z of every vertex.
    std::vector<double> coordinates(Status* status = nullptr) const {
        std::vector<double> values(3 * vertices(status));
        detail::check(roundel_soup_coordinates(get(), values.data(), values.size()), status);
        return values;
    }
    /// The number of corners of every polygon.
    std::vector<std::int32_t> sizes(Status* status = nullptr) const { return lists(status).first; }
    /// The corners of all polygons, one polygon after the other.
    std::vector<std::int64_t> corners(Status* status = nullptr) const {
        return lists(status).second;
    }

    /// The handle for calls of the C interface.
    const roundel_soup* get() const noexcept { return handle_.get(); }

  private:
    template <class Function, class Index>
    void make(Function function, span<const double> coordinates, span<const std::int32_t> sizes,
              span<const Index> corners, Status* status) {
        if (coordinates.size() % 3 != 0) {
            Status failure;
            failure.code = ROUNDEL_ERROR_LENGTH_MISMATCH;
            failure.message = "coordinates come in threes";
            detail::fail(std::move(failure), status);
            return;
        }
        roundel_soup* made = nullptr;
        detail::check(function(coordinates.size() / 3, coordinates.data(), sizes.size(),
                               sizes.data(), corners.size(), corners.data(), &made),
                      status);
        handle_.reset(made);
    }

    std::pair<std::size_t, std::size_t> counts(Status* status) const {
        std::pair<std::size_t, std::size_t> found(0, 0);
        detail::check(roundel_soup_polygon_counts(get(), &found.first, &found.second), status);
        return found;
    }

    std::pair<std::vector<std::int32_t>, std::vector<std::int64_t>> lists(Status* status) const {
        const auto length = counts(status);
        std::vector<std::int32_t> sizes(length.first);
        std::vector<std::int64_t> corners(length.second);
        detail::check(roundel_soup_polygons(get(), sizes.size(), sizes.data(), corners.size(),
                                            corners.data()),
                      status);
        return {std::move(sizes), std::move(corners)};
    }

    detail::Handle<roundel_soup, roundel_soup_free> handle_;
};

/// What repair may do beyond what a mesh needs. By default it welds vertices of equal position
/// only, drops no component and fills no hole.
struct RepairOptions {
    // Table of options: members.
    /// The distance up to which vertices are welded, in units of the mesh; at 0, those of equal
    /// position. In [0, inf); 0 by default.
    std::optional<double> weld = std::nullopt;
    /// The share of the area below which a component is dropped; 0 keeps all. In [0, 1]; 0 by
    /// default.
    std::optional<double> drop_components = std::nullopt;
    /// The largest number of edges of a hole that is filled; 0 fills none. In [0, 1000]; 0 by
    /// default.
    std::optional<std::int64_t> fill_holes = std::nullopt;
    // End of the table.

    // Table of options: setters.
    RepairOptions& set_weld(double value) {
        weld = value;
        return *this;
    }
    RepairOptions& set_drop_components(double value) {
        drop_components = value;
        return *this;
    }
    RepairOptions& set_fill_holes(std::int64_t value) {
        fill_holes = value;
        return *this;
    }
    // End of the table.
};

/// One thing that repair did. Vertices and polygons are those of the soup.
struct Edit {
    roundel_edit_kind kind;
    /// What it was done to: a vertex or a polygon, as the kind says.
    std::int32_t element;
    /// Another number, as the kind says; -1 where there is none.
    std::int32_t other;

    /// The word for the kind, such as "vertex_welded".
    std::string_view name() const noexcept { return roundel_edit_kind_name(kind); }
};

/// What repair makes of a soup: a mesh, the edits, and where its vertices and faces come from.
class Repair {
  public:
    /// Nothing: a call returns this when it reports a failure in a Status.
    Repair() noexcept = default;

    /// Takes ownership of a repair of the C interface.
    explicit Repair(roundel_repair* owned) noexcept : handle_(owned) {}

    /// Whether there is a mesh.
    explicit operator bool() const noexcept { return handle_ != nullptr; }

    /// The mesh.
    Mesh mesh(Status* status = nullptr) const {
        roundel_mesh* made = nullptr;
        detail::check(roundel_repair_mesh(get(), &made), status);
        return Mesh(made);
    }

    /// The number of edits of one kind.
    std::size_t count(roundel_edit_kind kind, Status* status = nullptr) const {
        std::size_t found = 0;
        detail::check(roundel_repair_count_of(get(), kind, &found), status);
        return found;
    }

    /// All edits, in the order in which they were made; none if the soup was a mesh as it is.
    std::vector<Edit> edits(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_repair_edit_count(get(), &count), status);
        std::vector<std::int32_t> kinds(count), elements(count), others(count);
        detail::check(
            roundel_repair_edits(get(), kinds.data(), elements.data(), others.data(), count),
            status);
        std::vector<Edit> found(count);
        for (std::size_t i = 0; i < count; ++i) {
            found[i] = {static_cast<roundel_edit_kind>(kinds[i]), elements[i], others[i]};
        }
        return found;
    }

    /// One line about the edits, such as "welded 12 vertices, split 3 vertices"; empty if nothing
    /// was done.
    std::string summary(Status* status = nullptr) const {
        std::size_t length = 0;
        if (!detail::check(roundel_repair_summary(get(), nullptr, 0, &length), status)) {
            return {};
        }
        std::string text(length, '\0');
        detail::check(roundel_repair_summary(get(), text.data(), length + 1, nullptr), status);
        return text;
    }

    /// The vertex of the soup that each vertex of the mesh comes from; -1 for one that repair made.
    std::vector<std::int32_t> vertex_origins(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_repair_vertex_count(get(), &count), status);
        return copied(roundel_repair_vertex_origins, count, status);
    }
    /// The polygon of the soup that each face of the mesh comes from; -1 for one that fills a hole.
    std::vector<std::int32_t> face_origins(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_repair_face_count(get(), &count), status);
        return copied(roundel_repair_face_origins, count, status);
    }
    /// The vertex to which each vertex of the soup was welded: itself if to none, -1 if its
    /// coordinates are not finite.
    std::vector<std::int32_t> welded_to(Status* status = nullptr) const {
        std::size_t count = 0;
        detail::check(roundel_repair_soup_vertex_count(get(), &count), status);
        return copied(roundel_repair_welded_to, count, status);
    }

    /// The edges of the mesh whose two faces differ in an attribute of the file that the soup was
    /// read from: "materials", "groups", "smoothing", "seams" or "normals" of OBJ, "colors" of the
    /// faces of PLY. They may be Features::edges.
    std::vector<std::int32_t> attribute_edges(const std::string& file, const std::string& attribute,
                                              Status* status = nullptr) const {
        const Mesh made = mesh(status);
        std::vector<std::int32_t> marks(made ? made.edges(status) : 0);
        std::vector<std::int32_t> edges;
        if (detail::check(roundel_repair_mark_attribute(get(), file.c_str(), attribute.c_str(),
                                                        marks.data(), marks.size()),
                          status)) {
            for (std::size_t edge = 0; edge < marks.size(); ++edge) {
                if (marks[edge] != 0) {
                    edges.push_back(static_cast<std::int32_t>(edge));
                }
            }
        }
        return edges;
    }

    /// The handle for calls of the C interface.
    const roundel_repair* get() const noexcept { return handle_.get(); }

  private:
    template <class Function>
    std::vector<std::int32_t> copied(Function function, std::size_t length, Status* status) const {
        std::vector<std::int32_t> values(length);
        detail::check(function(get(), values.data(), length), status);
        return values;
    }

    detail::Handle<roundel_repair, roundel_repair_free> handle_;
};

namespace detail {

// Table of options: lists.
template <class Tell> bool each_repair_option(const RepairOptions& options, const Tell& tell) {
    if (options.weld && !tell("weld", *options.weld)) {
        return false;
    }
    if (options.drop_components && !tell("drop_components", *options.drop_components)) {
        return false;
    }
    if (options.fill_holes && !tell("fill_holes", *options.fill_holes)) {
        return false;
    }
    return true;
}
// End of the table.

} // namespace detail

/// Makes an oriented manifold mesh of a soup, and says what it did. A soup that is one already
/// comes back as it is, unless its boundary edges lie on each other: then they are welded.
inline Repair repair(const Soup& soup, const RepairOptions& options = {},
                     Status* status = nullptr) {
    roundel_repair_options* set = nullptr;
    if (!detail::check(roundel_repair_options_new(&set), status)) {
        return {};
    }
    const detail::Handle<roundel_repair_options, roundel_repair_options_free> handle(set);
    const auto set_option =
        detail::by_name(roundel_repair_options_set_int, roundel_repair_options_set_real,
                        roundel_repair_options_set_text);
    const auto tell = [&](const char* name, const auto& value) {
        return detail::check(set_option(set, name, value), status);
    };
    roundel_repair* made = nullptr;
    if (detail::each_repair_option(options, tell)) {
        detail::check(roundel_soup_repair(soup.get(), set, &made), status);
    }
    return Repair(made);
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_REPAIR_HPP
