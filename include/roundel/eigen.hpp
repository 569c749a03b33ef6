/// Roundel for Eigen: problems from sparse matrices; fields, maps and quads of meshes in matrices.
///
///     problem.quadratic(Q, roundel::Triangle::full);            // Eigen::SparseMatrix<double>
///     problem.constrain(C, d);                                  // and a vector
///     auto field = roundel::orientation_field(V, F, {.constrain_curvature = 0.1});
///     auto found = roundel::matrices(field);
///     auto [UV, FUV] = roundel::matrices(roundel::parametrize(field, {.quads = 2000}));

#ifndef ROUNDEL_EIGEN_HPP
#define ROUNDEL_EIGEN_HPP

#include <roundel/roundel.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

ROUNDEL_NAMESPACE_BEGIN

namespace detail {

/// Gives Problem access to Eigen's sparse matrices.
template <int options, class Stored>
class CompressedView<Eigen::SparseMatrix<double, options, Stored>> {
  public:
    using Matrix = Eigen::SparseMatrix<double, options, Stored>;
    using Index = std::conditional_t<sizeof(Stored) == 8, std::int64_t, std::int32_t>;
    static_assert(std::is_same_v<Stored, std::int32_t> || sizeof(Stored) == 8,
                  "the storage index must be int or a 64-bit integer");

    explicit CompressedView(const Matrix& matrix) : matrix_(&matrix) {
        // An uncompressed matrix is compressed first.
        if (!matrix.isCompressed()) {
            packed_ = matrix;
            packed_.makeCompressed();
            matrix_ = &packed_;
        }
    }
    CompressedView(const CompressedView&) = delete;
    CompressedView& operator=(const CompressedView&) = delete;

    Compressed<Index> get() const {
        const auto outer = static_cast<std::size_t>(matrix_->outerSize());
        const auto count = static_cast<std::size_t>(matrix_->nonZeros());
        // long and long long are different types with the same 64 bits.
        const auto indices = [](const Stored* from) {
            return reinterpret_cast<const Index*>(from);
        };
        return {Matrix::IsRowMajor ? Layout::rows : Layout::columns,
                span<const Index>(indices(matrix_->outerIndexPtr()), outer + 1),
                span<const Index>(indices(matrix_->innerIndexPtr()), count),
                span<const double>(matrix_->valuePtr(), count)};
    }

  private:
    const Matrix* matrix_;
    Matrix packed_;
};

} // namespace detail

/// The mesh with vertices in the rows of V (x, y, z) and faces in the rows of F (three corners).
template <class V, class F>
Mesh adapt(const Eigen::MatrixBase<V>& vertices, const Eigen::MatrixBase<F>& faces,
           Status* status = nullptr) {
    static_assert(std::is_integral_v<typename F::Scalar>, "corners must be integers");
    if (faces.cols() != 3) {
        if (faces.rows() > 0) {
            Status failure;
            failure.code = ROUNDEL_ERROR_NOT_A_TRIANGLE;
            failure.message = "faces have " + std::to_string(faces.cols()) + " columns, not 3";
            detail::fail(std::move(failure), status);
            return {};
        }
    }
    if (vertices.cols() != 3) {
        Status failure;
        failure.code = ROUNDEL_ERROR_LENGTH_MISMATCH;
        failure.message = "vertices have " + std::to_string(vertices.cols()) + " columns, not 3";
        detail::fail(std::move(failure), status);
        return {};
    }
    std::vector<double> coordinates;
    std::vector<std::int64_t> corners;
    coordinates.reserve(static_cast<std::size_t>(3 * vertices.rows()));
    corners.reserve(static_cast<std::size_t>(3 * faces.rows()));
    for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            coordinates.push_back(static_cast<double>(vertices(i, axis)));
        }
    }
    for (Eigen::Index i = 0; i < faces.rows(); ++i) {
        for (Eigen::Index k = 0; k < 3; ++k) {
            corners.push_back(static_cast<std::int64_t>(faces(i, k)));
        }
    }
    return Mesh(span<const double>(coordinates.data(), coordinates.size()),
                span<const std::int64_t>(corners.data(), corners.size()), status);
}

/// A field together with the mesh on which it was computed.
struct EigenField : Field {
    EigenField() = default;
    EigenField(Field field, Mesh on) : Field(std::move(field)), mesh(std::move(on)) {}

    Mesh mesh{};
};

/// The smoothest field of a mesh in matrices that satisfies the constraints.
template <class V, class F>
EigenField orientation_field(const Eigen::MatrixBase<V>& vertices,
                             const Eigen::MatrixBase<F>& faces, const FieldOptions& options = {},
                             Status* status = nullptr) {
    Mesh mesh = adapt(vertices, faces, status);
    if (!mesh) {
        return {};
    }
    Field field = orientation_field(mesh, options, status);
    return {std::move(field), std::move(mesh)};
}

/// A field as Eigen's matrices.
struct FieldMatrices {
    /// The angle of one arm of every face's cross, from its first edge.
    Eigen::VectorXd angles;
    /// The two faces of every edge; the second is -1 at the boundary.
    Eigen::Matrix<std::int32_t, Eigen::Dynamic, 2, Eigen::RowMajor> edge_faces;
    /// The period jump of every edge, from its first to its second face.
    Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1> period_jumps;
    Eigen::VectorXd kappa;
    /// The index of every vertex in full turns; zero at the boundary.
    Eigen::VectorXd indices;
    /// The same in steps of 1/N of a turn, which are quarters for crosses.
    Eigen::Matrix<std::int32_t, Eigen::Dynamic, 1> index_steps;
};

inline FieldMatrices matrices(const EigenField& field, Status* status = nullptr) {
    const auto copied = [](auto values) {
        using T = std::remove_cv_t<typename decltype(values)::element_type>;
        using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
        return Vector(
            Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size())));
    };
    FieldMatrices to;
    to.angles = copied(field.angles());
    to.period_jumps = copied(field.period_jumps());
    to.kappa = copied(field.kappa());
    to.indices = copied(field.vertex_indices());
    to.index_steps = copied(field.vertex_index_steps());
    const auto sides = field.mesh.edge_faces(status);
    to.edge_faces = Eigen::Map<const decltype(to.edge_faces)>(
        sides.data(), static_cast<Eigen::Index>(sides.size() / 2), 2);
    return to;
}

/// The seamless map of an EigenField's mesh that follows the field.
inline Map parametrize(const EigenField& field, const MapOptions& options = {},
                       Status* status = nullptr) {
    return parametrize(field.mesh, field, options, status);
}

/// A map as Eigen's matrices. Corner k of face f has the coordinates UV.row(FUV(f, k)).
struct MapMatrices {
    /// u and v of every vertex of the cut surface.
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> UV;
    /// The three corners of every face as rows of UV.
    Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor> FUV;
};

inline MapMatrices matrices(const Map& map) {
    const auto rows = [](auto values, auto& to) {
        using Matrix = std::remove_reference_t<decltype(to)>;
        const auto count = static_cast<Eigen::Index>(values.size()) / Matrix::ColsAtCompileTime;
        to = Eigen::Map<const Matrix>(values.data(), count, Matrix::ColsAtCompileTime);
    };
    MapMatrices to;
    rows(map.vertex_uvs(), to.UV);
    rows(map.vertex_corners(), to.FUV);
    return to;
}

/// Quadrangulates a mesh in matrices.
template <class V, class F>
Quads quadrangulate(const Eigen::MatrixBase<V>& vertices, const Eigen::MatrixBase<F>& faces,
                    const QuadOptions& options = {}, Status* status = nullptr) {
    const Mesh mesh = adapt(vertices, faces, status);
    return mesh ? quadrangulate(mesh, options, status) : Quads();
}

/// Quads as Eigen's matrices. Other faces are left out.
struct QuadMatrices {
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> V;
    Eigen::Matrix<std::int32_t, Eigen::Dynamic, 4, Eigen::RowMajor> Q;
};

inline QuadMatrices matrices(const Quads& quads) {
    QuadMatrices to;
    to.V = Eigen::Map<const decltype(to.V)>(
        quads.vertices().data(), static_cast<Eigen::Index>(quads.vertices().size() / 3), 3);
    to.Q = Eigen::Map<const decltype(to.Q)>(quads.corners().data(),
                                            static_cast<Eigen::Index>(quads.size()), 4);
    return to;
}

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_EIGEN_HPP
