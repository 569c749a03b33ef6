// <roundel/eigen.hpp>: problems from sparse matrices, fields of meshes given as matrices.

#include "../../cpp/check.hpp"

#include <roundel/eigen.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <cstdint>

namespace {

constexpr double half_pi = 1.57079632679489661923;

/// A chain: 1/2 x'Qx + q'x, in which the last variable is an integer.
template <class Matrix> Matrix chain(Eigen::Index n) {
    Matrix q(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        q.insert(i, i) = 3.0;
        if (i > 0) {
            q.insert(i, i - 1) = -1.0;
            q.insert(i - 1, i) = -1.0;
        }
    }
    return q;
}

/// Compares the result with Eigen's own solution of the same equations.
template <class Matrix> void matrices_are_taken_as_they_are(bool compressed) {
    Matrix q = chain<Matrix>(4);
    if (compressed) {
        q.makeCompressed();
    }
    CHECK(q.isCompressed() == compressed);
    Matrix c(1, 4);
    c.insert(0, 0) = 1.0;
    c.insert(0, 3) = 2.0;
    c.makeCompressed();
    const Eigen::VectorXd d = Eigen::VectorXd::Constant(1, 2.5);
    const Eigen::Vector4d linear(-1.0, 0.5, 0.25, -2.0);

    roundel::Problem problem(4);
    problem.quadratic(q, roundel::Triangle::full);
    problem.linear(roundel::span<const double>(linear.data(), 4));
    CHECK(problem.constrain(c, d) == 0 && problem.constraints() == 1);
    // A term that is zero on the constraint does not change the minimiser.
    CHECK(problem.least_squares(c, d) == 0);
    const auto solution = roundel::solve(problem);

    Eigen::Matrix<double, 5, 5> kkt = Eigen::Matrix<double, 5, 5>::Zero();
    kkt.topLeftCorner<4, 4>() = Eigen::MatrixXd(q);
    kkt.bottomLeftCorner<1, 4>() = Eigen::MatrixXd(c);
    kkt.topRightCorner<4, 1>() = Eigen::MatrixXd(c).transpose();
    Eigen::Matrix<double, 5, 1> right;
    right << -linear, d;
    const Eigen::Matrix<double, 5, 1> expected = kkt.fullPivLu().solve(right);
    // x0 + 2 x3 is 2.5, which the row allows, and 2 <= x0 + 2 x3 <= 2.25 contradicts.
    const Eigen::VectorXd below = Eigen::VectorXd::Constant(1, 2.0);
    const Eigen::VectorXd above = Eigen::VectorXd::Constant(1, 2.25);
    CHECK(problem.inequality(c, below, d) == 0 && problem.inequalities() == 1);
    CHECK(std::abs(roundel::solve(problem).energy() - solution.energy()) < 1e-12);
    CHECK(problem.inequality(c, below, above) == 1);
    roundel::Status status;
    CHECK(!roundel::solve(problem, {}, &status) && status.code == ROUNDEL_ERROR_INFEASIBLE);

    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(std::abs(solution.values()[i] - expected[static_cast<Eigen::Index>(i)]) < 1e-12);
    }
}

void one_triangle_stands_for_both() {
    using Matrix = Eigen::SparseMatrix<double>;
    const Matrix q = chain<Matrix>(3);
    const Matrix upper = q.triangularView<Eigen::Upper>();
    const Matrix lower = q.triangularView<Eigen::Lower>();
    const Eigen::Vector3d linear(-1.0, 0.5, 0.25);
    double energies[3];
    const Matrix* given[3] = {&q, &upper, &lower};
    const roundel::Triangle triangles[3] = {roundel::Triangle::full, roundel::Triangle::upper,
                                            roundel::Triangle::lower};
    for (std::size_t i = 0; i < 3; ++i) {
        roundel::Problem problem(3);
        problem.quadratic(*given[i], triangles[i]);
        problem.linear(roundel::span<const double>(linear.data(), 3));
        energies[i] = roundel::solve(problem).energy();
    }
    CHECK(energies[0] == energies[1] && energies[0] == energies[2] && energies[0] < 0.0);
    roundel::Problem problem(3);
    roundel::Status status;
    problem.quadratic(upper, roundel::Triangle::full, &status);
    CHECK(status.code == ROUNDEL_ERROR_INVALID_ARGUMENT);
    problem.quadratic(chain<Matrix>(4), roundel::Triangle::full, &status);
    CHECK(!status);
}

template <class V, class F> void fields_are_found_in_matrices() {
    const auto shape = roundel::Mesh::shape("plate-with-holes", 800).jittered(1e-3, 1);
    const auto xyz = shape.coordinates();
    const auto corners = shape.corners();
    V vertices(static_cast<Eigen::Index>(shape.vertices()), 3);
    F faces(static_cast<Eigen::Index>(shape.faces()), 3);
    for (Eigen::Index i = 0; i < vertices.size(); ++i) {
        vertices(i / 3, i % 3) = static_cast<typename V::Scalar>(xyz[static_cast<std::size_t>(i)]);
    }
    for (Eigen::Index i = 0; i < faces.size(); ++i) {
        faces(i / 3, i % 3) = static_cast<typename F::Scalar>(corners[static_cast<std::size_t>(i)]);
    }
    const auto field = roundel::orientation_field(vertices, faces,
                                                  roundel::FieldOptions()
                                                      .set_constraints({{0, 0.5}, {90, 1.0}})
                                                      .set_features(roundel::no_features()));
    const auto found = roundel::matrices(field);
    CHECK(found.angles.size() == faces.rows() && found.angles[90] == 1.0);
    CHECK(found.indices.size() == vertices.rows());
    CHECK(found.index_steps.size() == vertices.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
        CHECK(found.indices[v] == 0.25 * found.index_steps[v]);
    }
    double energy = 0.0;
    for (Eigen::Index e = 0; e < found.edge_faces.rows(); ++e) {
        const auto i = found.edge_faces(e, 0), j = found.edge_faces(e, 1);
        if (j < 0) {
            CHECK(found.period_jumps[e] == 0);
            continue;
        }
        const double residual =
            found.angles[i] + found.kappa[e] + half_pi * found.period_jumps[e] - found.angles[j];
        energy += residual * residual;
    }
    CHECK(energy > 0.0 && std::abs(energy - field.energy()) <= 1e-9 * energy);

    const auto map = roundel::parametrize(field, roundel::MapOptions().set_quads(200));
    const auto [UV, FUV] = roundel::matrices(map);
    CHECK(UV.rows() > vertices.rows() && FUV.rows() == faces.rows());
    CHECK(FUV.maxCoeff() == UV.rows() - 1 && FUV.minCoeff() == 0);
    for (Eigen::Index k = 0; k < FUV.size(); ++k) {
        const auto row = UV.row(FUV(k / 3, k % 3));
        CHECK(row[0] == map.corner_uvs()[static_cast<std::size_t>(2 * k)]);
        CHECK(row[1] == map.corner_uvs()[static_cast<std::size_t>(2 * k + 1)]);
    }
}

void quads_come_back_as_matrices() {
    const auto mesh = roundel::Mesh::shape("sphere", 500);
    const auto quads = roundel::quadrangulate(mesh, roundel::QuadOptions().set_quads(150));
    const auto found = roundel::matrices(quads);
    CHECK(quads.conforming() && found.V.rows() == found.Q.rows() + 2);
    CHECK(found.Q.minCoeff() == 0 && found.Q.maxCoeff() == found.V.rows() - 1);
}

void matrices_of_another_shape_are_refused() {
    roundel::Status status;
    const Eigen::MatrixXd flat = Eigen::MatrixXd::Random(4, 2),
                          solid = Eigen::MatrixXd::Random(4, 3);
    const Eigen::MatrixXi quads = Eigen::MatrixXi::Zero(1, 4);
    Eigen::MatrixXi faces(1, 3);
    faces << 0, 1, 4;
    CHECK(!roundel::orientation_field(solid, quads, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_NOT_A_TRIANGLE);
    CHECK(!roundel::orientation_field(flat, faces, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_LENGTH_MISMATCH);
    CHECK(!roundel::orientation_field(solid, faces, {}, &status));
    CHECK(status.code == ROUNDEL_ERROR_INDEX_OUT_OF_RANGE && status.index == 2);
}

} // namespace

int main() {
    using Long = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;
    for (const bool compressed : {true, false}) {
        matrices_are_taken_as_they_are<Eigen::SparseMatrix<double>>(compressed);
        matrices_are_taken_as_they_are<Eigen::SparseMatrix<double, Eigen::RowMajor>>(compressed);
        matrices_are_taken_as_they_are<Long>(compressed);
    }
    one_triangle_stands_for_both();
    fields_are_found_in_matrices<Eigen::MatrixXd, Eigen::MatrixXi>();
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
    fields_are_found_in_matrices<Rows, Eigen::Matrix<std::int64_t, Eigen::Dynamic, 3>>();
    quads_come_back_as_matrices();
    matrices_of_another_shape_are_refused();
    return failures != 0;
}
