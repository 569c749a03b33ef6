// GMM's functions on matrices and vectors, each compared with a calculation on dense arrays.

#include "zoo.hpp"

#include <stdexcept>
#include <type_traits>

namespace {

using Dense = std::vector<std::vector<double>>;
using Compressed = gmm::csc_matrix<double>;

// Numbers of both signs, with zeros between them.
double number(std::size_t i, std::size_t j) {
    const std::size_t mixed = (7 * i + 5 * j + i * j) % 11;
    return mixed % 3 == 0 ? 0.0 : 0.75 * static_cast<double>(mixed) - 3.0;
}

Dense numbers(std::size_t rows, std::size_t cols) {
    Dense dense(rows, std::vector<double>(cols));
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < cols; ++j) {
            dense[i][j] = number(i, j);
        }
    }
    return dense;
}

template <class Matrix> Matrix filled(const Dense& dense) {
    Matrix matrix(dense.size(), dense[0].size());
    for (std::size_t i = 0; i < dense.size(); ++i) {
        for (std::size_t j = 0; j < dense[0].size(); ++j) {
            if (dense[i][j] != 0.0) {
                matrix(i, j) = dense[i][j];
            }
        }
    }
    return matrix;
}

Compressed compressed(const Dense& dense) {
    Compressed matrix;
    gmm::copy(filled<RowMatrix>(dense), matrix);
    return matrix;
}

template <class Matrix> bool same(const Matrix& matrix, const Dense& dense) {
    if (gmm::mat_nrows(matrix) != dense.size() || gmm::mat_ncols(matrix) != dense[0].size()) {
        return false;
    }
    for (std::size_t i = 0; i < dense.size(); ++i) {
        for (std::size_t j = 0; j < dense[0].size(); ++j) {
            if (!near(matrix(i, j), dense[i][j], 1e-12)) {
                return false;
            }
        }
    }
    return true;
}

Dense transpose(const Dense& a) {
    Dense turned(a[0].size(), std::vector<double>(a.size()));
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < a[0].size(); ++j) {
            turned[j][i] = a[i][j];
        }
    }
    return turned;
}

Dense product(const Dense& a, const Dense& b) {
    Dense c(a.size(), std::vector<double>(b[0].size(), 0.0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t k = 0; k < b.size(); ++k) {
            for (std::size_t j = 0; j < b[0].size(); ++j) {
                c[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    return c;
}

Dense times(Dense a, double factor) {
    for (auto& row : a) {
        for (double& value : row) {
            value *= factor;
        }
    }
    return a;
}

std::vector<double> column(const Dense& a, std::size_t j) {
    return transpose(a)[j];
}

const Dense wide = numbers(4, 6);
const Dense tall = numbers(6, 3);

// Products with vectors, for each type of matrix.
template <class Matrix> void multiplies(const Matrix& matrix, const Dense& dense) {
    const Dense x = numbers(dense[0].size(), 1);
    const Dense b = numbers(dense.size(), 3);
    std::vector<double> y(dense.size(), 7.0);
    gmm::mult(matrix, column(x, 0), y);
    CHECK(near(y, column(product(dense, x), 0)));

    // b + A x, and b - 2 A x.
    std::vector<double> right = column(b, 2);
    std::vector<double> expected = y;
    for (std::size_t i = 0; i < y.size(); ++i) {
        expected[i] += right[i];
    }
    gmm::mult(matrix, column(x, 0), right, y);
    CHECK(near(y, expected));
    const std::vector<double> factors = column(x, 0);
    gmm::mult(matrix, gmm::scaled(factors, -2.0), right, y);
    for (std::size_t i = 0; i < y.size(); ++i) {
        CHECK(near(y[i], right[i] - 2.0 * column(product(dense, x), 0)[i], 1e-12));
    }
    // The transposed matrix.
    std::vector<double> back(dense[0].size());
    gmm::mult(gmm::transposed(matrix), right, back);
    const Dense turned = product(transpose(dense), transpose({right}));
    CHECK(near(back, column(turned, 0)));
}

} // namespace

void products_are_those_of_dense_matrices() {
    multiplies(filled<RowMatrix>(wide), wide);
    multiplies(filled<ColMatrix>(wide), wide);
    multiplies(compressed(wide), wide);

    const ColMatrix A = filled<ColMatrix>(wide);
    const ColMatrix B = filled<ColMatrix>(tall);
    ColMatrix AB(4, 3);
    gmm::mult(A, B, AB);
    CHECK(same(AB, product(wide, tall)));
    RowMatrix rows(4, 3);
    gmm::mult(filled<RowMatrix>(wide), filled<RowMatrix>(tall), rows);
    CHECK(same(rows, product(wide, tall)));
    // The matrix of normal equations.
    ColMatrix normal(6, 6);
    gmm::mult(gmm::transposed(A), A, normal);
    CHECK(same(normal, product(transpose(wide), wide)));
}

void copies_and_multiples_are_those_of_dense_matrices() {
    const RowMatrix rows = filled<RowMatrix>(wide);
    ColMatrix cols(4, 6);
    cols(3, 5) = 9.0;
    gmm::copy(rows, cols);
    CHECK(same(cols, wide) && gmm::nnz(cols) == gmm::nnz(rows));
    ColMatrix turned(6, 4);
    gmm::copy(gmm::transposed(rows), turned);
    CHECK(same(turned, transpose(wide)));
    gmm::copy(gmm::scaled(rows, -0.5), cols);
    CHECK(same(cols, times(wide, -0.5)));
    gmm::scale(cols, -4.0);
    CHECK(same(cols, times(wide, 2.0)));

    // A compressed matrix takes the size of its source, and has its columns in order.
    Compressed packed(1, 1);
    gmm::copy(rows, packed);
    CHECK(same(packed, wide) && gmm::nnz(packed) == gmm::nnz(rows));
    CHECK(packed.nrows() == 4 && packed.ncols() == 6 && packed.jc[0] == 0);
    for (std::size_t j = 0; j < 6; ++j) {
        for (std::size_t k = packed.jc[j]; k < packed.jc[j + 1]; ++k) {
            CHECK(packed.pr[k] == wide[packed.ir[k]][j]);
            CHECK(k == packed.jc[j] || packed.ir[k - 1] < packed.ir[k]);
        }
    }
    Compressed again;
    again.init_with(filled<ColMatrix>(tall));
    CHECK(same(again, tall));
    again.init_with_good_format(filled<ColMatrix>(wide));
    CHECK(same(again, wide));
    gmm::copy(gmm::transposed(again), turned);
    CHECK(same(turned, transpose(wide)));

    // Vectors, dense and sparse.
    const std::vector<double> values = column(wide, 1);
    gmm::wsvector<double> sparse(4);
    sparse[2] = 5.0;
    gmm::copy(values, sparse);
    std::vector<double> back(4);
    gmm::copy(gmm::scaled(sparse, 3.0), back);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(sparse[i] == values[i] && back[i] == 3.0 * values[i]);
    }
    gmm::scale(back, 0.5);
    CHECK(near(back[3], 1.5 * values[3]) && values[3] != 0.0);

#ifdef ROUNDEL_GMM_SHIM
    // GMM++ checks sizes in its debug mode alone.
    bool refused = false;
    try {
        gmm::copy(rows, turned);
    } catch (const std::invalid_argument&) {
        refused = true;
    }
    CHECK(refused && same(turned, transpose(wide)));
#endif
}

namespace {

// As programs declare the types: the sums of a column's entries, and of entries times rows.
template <class Matrix> void visits(const Matrix& matrix, const Dense& dense) {
    // With some versions of GMM++ it is a reference.
    using Column = std::decay_t<typename gmm::linalg_traits<Matrix>::const_sub_col_type>;
    using Iterator = typename gmm::linalg_traits<Column>::const_iterator;
    for (std::size_t j = 0; j < dense[0].size(); ++j) {
        const Column& of = gmm::mat_const_col(matrix, j);
        std::vector<double> found(dense.size(), 0.0);
        std::size_t count = 0;
        std::size_t stored = 0;
        Iterator end = gmm::vect_const_end(of);
        for (Iterator it = gmm::vect_const_begin(of); it != end; ++it) {
            found[it.index()] += *it;
            ++count;
        }
        for (std::size_t i = 0; i < dense.size(); ++i) {
            stored += dense[i][j] != 0.0 ? 1 : 0;
            CHECK(of[i] == dense[i][j]);
        }
        CHECK(found == column(dense, j) && count == stored && gmm::vect_size(of) == dense.size());
    }
}

} // namespace

void columns_visit_their_entries() {
    visits(filled<ColMatrix>(wide), wide);
    visits(compressed(wide), wide);
    visits(filled<ColMatrix>(tall), tall);
    const ColMatrix matrix = filled<ColMatrix>(tall);
    std::vector<double> copied(6);
    gmm::copy(gmm::mat_const_col(matrix, 2), copied);
    CHECK(copied == column(tall, 2));
}

void small_entries_are_removed() {
    const auto noisy = [](auto matrix) {
        matrix(0, 0) = 1e-13;
        matrix(2, 1) = -1e-13;
        matrix(1, 1) = -2.0;
        matrix(1, 2) = 1e-3;
        CHECK(gmm::nnz(matrix) == 4);
        gmm::clean(matrix, 1e-10);
        CHECK(gmm::nnz(matrix) == 2);
        CHECK(same(matrix, {{0.0, 0.0, 0.0}, {0.0, -2.0, 1e-3}, {0.0, 0.0, 0.0}}));
    };
    noisy(RowMatrix(3, 3));
    noisy(ColMatrix(3, 3));
    gmm::wsvector<double> sparse(3);
    sparse[0] = 1.0;
    sparse[1] = -1e-12;
    gmm::clean(sparse, 1e-10);
    CHECK(gmm::nnz(sparse) == 1 && sparse[0] == 1.0);
    std::vector<double> numbers{1.0, -1e-12, 1e-12, -1.0};
    gmm::clean(numbers, 1e-10);
    CHECK(numbers == (std::vector<double>{1.0, 0.0, 0.0, -1.0}));
}
