/// Attributes of meshes, read from their files.

#ifndef ROUNDEL_DETAIL_ATTRIBUTES_HPP
#define ROUNDEL_DETAIL_ATTRIBUTES_HPP

#include <roundel/detail/mesh.hpp>
#include <roundel/detail/repair.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

/// A name for each face, such as that of its material.
struct FaceNames {
    /// All names.
    std::vector<std::string> names{};
    /// The place of each face's name there, or -1. Quads::transfer_face_labels carries them to
    /// quads.
    std::vector<std::int32_t> labels{};
};

/// A number for every vertex. NaN stands for none.
struct VertexScalar {
    std::string name{};
    std::vector<double> values{};
};

/// What a file says of a mesh beside its positions; what it does not say is empty. Colours are red,
/// green, blue and alpha from 0 to 1. NaN stands for none.
struct Attributes {
    FaceNames materials{};
    FaceNames groups{};
    /// Four numbers a face.
    std::vector<double> face_colors{};
    /// Two numbers for each of the three corners of each face.
    std::vector<double> uv{};
    /// Four numbers a vertex.
    std::vector<double> vertex_colors{};
    std::vector<VertexScalar> scalars{};
};

namespace detail {

/// Copies what there is out of a handle.
class AttributeReader {
  public:
    AttributeReader(roundel_attributes* owned, std::size_t vertices, std::size_t faces,
                    Status* status)
        : handle_(owned), vertices_(vertices), faces_(faces), status_(status) {}

    Attributes all() const {
        Attributes found;
        found.materials = face_names("materials");
        found.groups = face_names("groups");
        found.face_colors = values("face_colors", 4 * faces_);
        found.uv = values("uv", 6 * faces_);
        found.vertex_colors = values("vertex_colors", 4 * vertices_);
        auto names = this->names("scalars");
        for (std::size_t i = 0; i < names.size(); ++i) {
            std::vector<double> numbers(vertices_);
            if (told(roundel_attributes_scalar(handle_.get(), i, numbers.data(), vertices_))) {
                found.scalars.push_back({std::move(names[i]), std::move(numbers)});
            }
        }
        return found;
    }

  private:
    bool told(roundel_status code) const { return check(code, status_); }

    bool has(const char* kind) const {
        std::int32_t value = 0;
        return told(roundel_attributes_has(handle_.get(), kind, &value)) && value != 0;
    }

    std::vector<std::string> names(const char* kind) const {
        std::size_t count = 0;
        if (!told(roundel_attributes_name_count(handle_.get(), kind, &count))) {
            return {};
        }
        std::vector<std::string> found(count);
        for (std::size_t i = 0; i < count; ++i) {
            std::size_t length = 0;
            if (!told(roundel_attributes_name(handle_.get(), kind, i, nullptr, 0, &length))) {
                return {};
            }
            std::vector<char> text(length + 1);
            if (!told(roundel_attributes_name(handle_.get(), kind, i, text.data(), text.size(),
                                              nullptr))) {
                return {};
            }
            found[i].assign(text.data(), length);
        }
        return found;
    }

    FaceNames face_names(const char* kind) const {
        FaceNames found;
        if (has(kind)) {
            found.names = names(kind);
            found.labels.resize(faces_);
            told(roundel_attributes_labels(handle_.get(), kind, found.labels.data(), faces_));
        }
        return found;
    }

    std::vector<double> values(const char* kind, std::size_t length) const {
        std::vector<double> found(has(kind) ? length : 0);
        if (!found.empty()) {
            told(roundel_attributes_values(handle_.get(), kind, found.data(), found.size()));
        }
        return found;
    }

    Handle<roundel_attributes, roundel_attributes_free> handle_;
    std::size_t vertices_;
    std::size_t faces_;
    Status* status_;
};

} // namespace detail

/// The attributes of a mesh from the file that Mesh::read read it from.
inline Attributes attributes(const Mesh& mesh, const std::string& file, Status* status = nullptr) {
    roundel_attributes* made = nullptr;
    if (!detail::check(roundel_mesh_read_attributes(mesh.get(), file.c_str(), &made), status)) {
        return {};
    }
    return detail::AttributeReader(made, mesh.vertices(status), mesh.faces(status), status).all();
}

/// The attributes of a repaired mesh from the file that its soup was read from. Faces that fill
/// holes have none.
inline Attributes attributes(const Repair& repair, const std::string& file,
                             Status* status = nullptr) {
    roundel_attributes* made = nullptr;
    if (!detail::check(roundel_repair_read_attributes(repair.get(), file.c_str(), &made), status)) {
        return {};
    }
    std::size_t vertices = 0, faces = 0;
    detail::check(roundel_repair_vertex_count(repair.get(), &vertices), status);
    detail::check(roundel_repair_face_count(repair.get(), &faces), status);
    return detail::AttributeReader(made, vertices, faces, status).all();
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_ATTRIBUTES_HPP
