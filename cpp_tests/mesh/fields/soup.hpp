// A mesh as plain arrays, from which each mesh library builds its own.

#ifndef SOUP_HPP
#define SOUP_HPP

#include <roundel/roundel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct Soup {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<std::int32_t, 3>> faces;
};

/// The angles of the constrained faces; the others have none.
using Fixed = std::vector<std::optional<double>>;

inline Soup soup_of(const roundel::Mesh& mesh) {
    const auto xyz = mesh.coordinates();
    const auto corners = mesh.corners();
    Soup soup;
    for (std::size_t v = 0; v < xyz.size(); v += 3) {
        soup.points.push_back({xyz[v], xyz[v + 1], xyz[v + 2]});
    }
    for (std::size_t f = 0; f < corners.size(); f += 3) {
        soup.faces.push_back({corners[f], corners[f + 1], corners[f + 2]});
    }
    return soup;
}

#endif
