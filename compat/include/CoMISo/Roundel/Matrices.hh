/// Reads the entries of the caller's matrices and vectors: those of the gmm.h beside this library,
/// of the real GMM++ and of Eigen.

#ifndef COMISO_ROUNDEL_MATRICES_HH
#define COMISO_ROUNDEL_MATRICES_HH

#include <gmm/gmm.h>

#include <roundel/roundel.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace COMISO {
namespace roundel_detail {

/// A sparse matrix as its entries. Entries at the same place are summed.
struct Entries {
    std::size_t rows = 0;
    std::size_t cols = 0;
    std::vector<std::int64_t> row;
    std::vector<std::int64_t> col;
    std::vector<double> value;

    void add(std::size_t i, std::size_t j, double v) {
        if (v != 0.0) {
            row.push_back(static_cast<std::int64_t>(i));
            col.push_back(static_cast<std::int64_t>(j));
            value.push_back(v);
        }
    }
};

/// Whether a type has Eigen's iterator over a column or row of a sparse matrix.
template <class Matrix, class = void> struct is_eigen : std::false_type {};
template <class Matrix>
struct is_eigen<Matrix, std::void_t<typename Matrix::InnerIterator>> : std::true_type {};

template <class Matrix> Entries eigen_entries(const Matrix& matrix) {
    Entries entries;
    entries.rows = static_cast<std::size_t>(matrix.rows());
    entries.cols = static_cast<std::size_t>(matrix.cols());
    for (auto k = matrix.outerSize() * 0; k < matrix.outerSize(); ++k) {
        for (typename Matrix::InnerIterator it(matrix, k); it; ++it) {
            entries.add(static_cast<std::size_t>(it.row()), static_cast<std::size_t>(it.col()),
                        static_cast<double>(it.value()));
        }
    }
    return entries;
}

#if defined(ROUNDEL_GMM_SHIM)

template <class Matrix> void add_entries(const Matrix& matrix, Entries& entries) {
    matrix.for_each_entry(
        [&](std::size_t i, std::size_t j, double value) { entries.add(i, j, value); });
}

#else

template <class Matrix>
void add_entries_of(const Matrix& matrix, Entries& entries, gmm::row_major /*along*/) {
    for (std::size_t i = 0; i < entries.rows; ++i) {
        const auto row = gmm::mat_const_row(matrix, i);
        const auto end = gmm::vect_const_end(row);
        for (auto it = gmm::vect_const_begin(row); it != end; ++it) {
            entries.add(i, it.index(), *it);
        }
    }
}

template <class Matrix>
void add_entries_of(const Matrix& matrix, Entries& entries, gmm::col_major /*along*/) {
    for (std::size_t j = 0; j < entries.cols; ++j) {
        const auto col = gmm::mat_const_col(matrix, j);
        const auto end = gmm::vect_const_end(col);
        for (auto it = gmm::vect_const_begin(col); it != end; ++it) {
            entries.add(it.index(), j, *it);
        }
    }
}

template <class Matrix> void add_entries(const Matrix& matrix, Entries& entries) {
    using Traits = gmm::linalg_traits<Matrix>;
    using Along =
        typename gmm::principal_orientation_type<typename Traits::sub_orientation>::potype;
    add_entries_of(matrix, entries, Along());
}

#endif

/// The entries of a matrix of GMM++ or Eigen.
template <class Matrix> Entries entries_of(const Matrix& matrix) {
    if constexpr (is_eigen<Matrix>::value) {
        return eigen_entries(matrix);
    } else {
        Entries entries;
        entries.rows = gmm::mat_nrows(matrix);
        entries.cols = gmm::mat_ncols(matrix);
        add_entries(matrix, entries);
        return entries;
    }
}

/// The numbers of any vector that has a size and an index operator.
template <class Vector> std::vector<double> numbers_of(const Vector& vector) {
    std::vector<double> numbers(static_cast<std::size_t>(vector.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        // Eigen's vectors have signed indices, others unsigned ones.
        numbers[i] = static_cast<double>(vector[static_cast<decltype(vector.size())>(i)]);
    }
    return numbers;
}

/// Resizes `vector` and fills it with the values of a solution.
template <class Vector> void store(const ::roundel::Solution& solution, Vector& vector) {
    using Size = decltype(vector.size());
    const auto values = solution.values();
    vector.resize(static_cast<Size>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        vector[static_cast<Size>(i)] = values[i];
    }
}

} // namespace roundel_detail
} // namespace COMISO

#endif // COMISO_ROUNDEL_MATRICES_HH
