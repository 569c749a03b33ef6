/// Copies, products, multiples, and the removal of small entries. A result may be one of the
/// arguments. Sizes that do not fit throw std::invalid_argument.

#ifndef ROUNDEL_GMM_SHIM_OPERATIONS_H
#define ROUNDEL_GMM_SHIM_OPERATIONS_H

#include <gmm/shim/compressed.h>
#include <gmm/shim/matrices.h>
#include <gmm/shim/vectors.h>
#include <gmm/shim/views.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gmm {

inline void require_same_size(bool same) {
    if (!same) {
        throw std::invalid_argument("gmm: the sizes do not fit");
    }
}

/// All entries of a vector, zeros too.
template <class Vector> std::vector<typename Vector::value_type> dense(const Vector& vector) {
    using T = typename Vector::value_type;
    std::vector<T> numbers(vector.size(), T(0));
    visit_vector(vector, [&](size_type i, T value) { numbers[i] = value; });
    return numbers;
}

template <class T> void set_zero(std::vector<T>& vector) {
    std::fill(vector.begin(), vector.end(), T(0));
}
template <class T> void set_zero(wsvector<T>& vector) {
    vector.clear();
}

/// Copies a matrix to one of the same size, or a vector to one of the same length.
template <class Source, class Target> void copy(const Source& source, Target& target) {
    using T = typename Source::value_type;
    if constexpr (is_matrix<Source>::value) {
        require_same_size(source.nrows() == target.nrows() && source.ncols() == target.ncols());
        struct Entry {
            size_type i, j;
            T value;
        };
        std::vector<Entry> entries;
        source.for_each_entry([&](size_type i, size_type j, T value) {
            entries.push_back({i, j, value});
        });
        target.clear_mat();
        for (const Entry& entry : entries) {
            target(entry.i, entry.j) = entry.value;
        }
    } else {
        require_same_size(source.size() == target.size());
        std::vector<std::pair<size_type, T>> entries;
        visit_vector(source, [&](size_type i, T value) { entries.emplace_back(i, value); });
        set_zero(target);
        for (const auto& [i, value] : entries) {
            target[i] = value;
        }
    }
}

/// Copies a matrix to a compressed one, which takes its size.
template <class Source, class T> void copy(const Source& source, csc_matrix<T>& target) {
    target.init_with(source);
}

/// y = A x + b.
template <class Matrix, class Vector, class Right, class Target>
void mult(const Matrix& A, const Vector& x, const Right& b, Target& y) {
    using T = typename Matrix::value_type;
    require_same_size(A.ncols() == x.size() && A.nrows() == b.size() && A.nrows() == y.size());
    const std::vector<T> factors = dense(x);
    std::vector<T> sums = dense(b);
    A.for_each_entry([&](size_type i, size_type j, T value) { sums[i] += value * factors[j]; });
    copy(sums, y);
}

/// y = A x, for a vector x or a matrix.
template <class Matrix, class Factor, class Target>
void mult(const Matrix& A, const Factor& x, Target& y) {
    using T = typename Matrix::value_type;
    if constexpr (is_matrix<Factor>::value) {
        require_same_size(A.ncols() == x.nrows());
        std::vector<std::vector<std::pair<size_type, T>>> rows(x.nrows());
        x.for_each_entry(
            [&](size_type i, size_type j, T value) { rows[i].emplace_back(j, value); });
        row_matrix<wsvector<T>> product(A.nrows(), x.ncols());
        A.for_each_entry([&](size_type i, size_type k, T value) {
            for (const auto& [j, other] : rows[k]) {
                product(i, j) += value * other;
            }
        });
        copy(product, y);
    } else {
        mult(A, x, std::vector<T>(A.nrows(), T(0)), y);
    }
}

/// Multiplies all entries by a factor.
template <class Object, class Factor> void scale(Object& object, Factor factor) {
    copy(scaled(object, factor), object);
}

/// Makes the entries zero whose absolute value is at most `threshold`.
template <class T> void clean(std::vector<T>& vector, double threshold) {
    std::replace_if(
        vector.begin(), vector.end(), [&](T value) { return std::abs(value) <= threshold; }, T(0));
}
template <class T> void clean(wsvector<T>& vector, double threshold) {
    std::vector<size_type> small;
    vector.for_each_entry([&](size_type index, T value) {
        if (std::abs(value) <= threshold) {
            small.push_back(index);
        }
    });
    for (size_type index : small) {
        vector.w(index, T(0));
    }
}
template <class Vector> void clean(row_matrix<Vector>& matrix, double threshold) {
    for (size_type i = 0; i < matrix.nrows(); ++i) {
        clean(matrix.row(i), threshold);
    }
}
template <class Vector> void clean(col_matrix<Vector>& matrix, double threshold) {
    for (size_type j = 0; j < matrix.ncols(); ++j) {
        clean(matrix.col(j), threshold);
    }
}

} // namespace gmm

#endif
