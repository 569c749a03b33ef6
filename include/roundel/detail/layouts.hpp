/// Base layouts, and quads that follow them.

#ifndef ROUNDEL_DETAIL_LAYOUTS_HPP
#define ROUNDEL_DETAIL_LAYOUTS_HPP

#include <roundel/detail/mesh.hpp>
#include <roundel/detail/quads.hpp>
#include <roundel/detail/repair.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A base layout: a coarse mesh of polygons anywhere near a surface. Its vertices mark points of
/// the surface, its edges are the arcs, its polygons the patches. Arcs are numbered in the order in
/// which polygons name them.
class BaseLayout {
  public:
    /// No layout: a call returns this when it reports a failure in a Status.
    BaseLayout() noexcept = default;

    /// The layout of vertices (x, y, z in turn) and polygons, given by their numbers of corners and
    /// the corners of all, one after the other. A failure names the polygon or the vertex.
    BaseLayout(span<const double> vertices, span<const std::int32_t> sizes,
               span<const std::int32_t> corners, Status* status = nullptr) {
        roundel_layout* made = nullptr;
        detail::check(roundel_layout_new(vertices.size() / 3, vertices.data(), sizes.size(),
                                         sizes.data(), corners.size(), corners.data(), &made),
                      status);
        handle_.reset(made);
    }

    /// Reads an OBJ file of vertices and polygons, with lines for arcs whose course is given.
    static BaseLayout read(const std::string& file, Status* status = nullptr) {
        BaseLayout layout;
        roundel_layout* made = nullptr;
        detail::check(roundel_layout_read(file.c_str(), &made), status);
        layout.handle_.reset(made);
        return layout;
    }

    /// Finds the layout of quads, with every arc drawn: the base complex for a deviation of 0, else
    /// one with the same irregular vertices and fewer patches, whose arcs drift at most so many
    /// edges across the lines of the quads. A failure names the quad, the edge or the vertex.
    static BaseLayout of_quads(const Soup& quads, double deviation = 0.0,
                               Status* status = nullptr) {
        BaseLayout layout;
        roundel_layout* made = nullptr;
        detail::check(roundel_layout_of_quads(quads.get(), deviation, nullptr, &made), status);
        layout.handle_.reset(made);
        return layout;
    }

    /// Writes an OBJ file, which `read` reads.
    void write(const std::string& file, Status* status = nullptr) const {
        detail::check(roundel_layout_write(get(), file.c_str()), status);
    }

    /// The vertices and the polygons.
    Soup soup(Status* status = nullptr) const {
        roundel_soup* made = nullptr;
        detail::check(roundel_layout_soup(get(), &made), status);
        return Soup(made);
    }

    /// The two vertices of each arc.
    std::vector<std::array<std::int32_t, 2>> arcs(Status* status = nullptr) const {
        std::size_t count = 0;
        if (!detail::check(roundel_layout_arc_count(get(), &count), status)) {
            return {};
        }
        std::vector<std::int32_t> ends(2 * count);
        detail::check(roundel_layout_arcs(get(), ends.data(), ends.size()), status);
        std::vector<std::array<std::int32_t, 2>> found;
        for (std::size_t i = 0; i < ends.size(); i += 2) {
            found.push_back({ends[i], ends[i + 1]});
        }
        return found;
    }

    /// Fixes the number of edges of quads along an arc; 0 leaves it free.
    BaseLayout& fix_arc(std::size_t arc, std::int32_t edges, Status* status = nullptr) {
        detail::check(roundel_layout_fix_arc(handle_.get(), arc, edges), status);
        return *this;
    }

    /// Gives the way of an arc by points near the surface, x, y, z in turn, from its first end to
    /// its second; no points leave it free.
    BaseLayout& draw_arc(std::size_t arc, span<const double> points, Status* status = nullptr) {
        detail::check(roundel_layout_draw_arc(handle_.get(), arc, points.size() / 3, points.data()),
                      status);
        return *this;
    }

    /// Keeps arcs whose course is given on it; else they slide.
    BaseLayout& hold_arcs(bool held = true, Status* status = nullptr) {
        detail::check(roundel_layout_hold_arcs(handle_.get(), held ? 1 : 0), status);
        return *this;
    }

    /// The handle for calls of the C interface.
    const roundel_layout* get() const noexcept { return handle_.get(); }

  private:
    detail::Handle<roundel_layout, roundel_layout_free> handle_;
};

/// Quads that follow a layout.
struct LayoutQuads {
    /// The quads.
    Quads quads{};
    /// The number of edges of quads along each arc.
    std::vector<std::int32_t> subdivisions{};
};

/// Makes about `count` quads that follow a layout, or as few as it allows for 0. A failure names
/// the vertex, the arc or the patch of the layout at fault.
inline LayoutQuads quads_of_layout(const Mesh& mesh, const BaseLayout& layout,
                                   std::size_t count = 1000, Status* status = nullptr) {
    LayoutQuads found;
    std::size_t arcs = 0;
    if (!detail::check(roundel_layout_arc_count(layout.get(), &arcs), status)) {
        return found;
    }
    found.subdivisions.resize(arcs);
    roundel_quads* made = nullptr;
    if (detail::check(roundel_quads_make_layout(mesh.get(), layout.get(), count, nullptr,
                                                found.subdivisions.data(), arcs, &made),
                      status)) {
        found.quads = Quads(made, status);
    }
    return found;
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_LAYOUTS_HPP
