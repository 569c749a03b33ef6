/// The compressed matrix for reading.

#ifndef ROUNDEL_GMM_SHIM_COMPRESSED_H
#define ROUNDEL_GMM_SHIM_COMPRESSED_H

#include <gmm/shim/matrices.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace gmm {

/// A matrix in compressed columns: column j has the values pr[k] in the rows ir[k], for k from
/// jc[j] up to but not including jc[j + 1]. It is filled at once, from another matrix.
template <class T> class csc_matrix {
  public:
    using value_type = T;
    using access_type = T;

    std::vector<T> pr;
    std::vector<unsigned int> ir;
    std::vector<unsigned int> jc;
    size_type nc = 0;
    size_type nr = 0;

    csc_matrix() : jc(1, 0) {}
    /// A matrix of zeros.
    csc_matrix(size_type rows, size_type columns) : jc(columns + 1, 0), nc(columns), nr(rows) {}

    size_type nrows() const { return nr; }
    size_type ncols() const { return nc; }

    T operator()(size_type i, size_type j) const {
        const auto begin = ir.begin() + jc.at(j);
        const auto end = ir.begin() + jc.at(j + 1);
        const auto found = std::lower_bound(begin, end, i);
        return found == end || *found != i ? T(0) : pr[static_cast<size_type>(found - ir.begin())];
    }

    /// Takes the size and the entries of another matrix.
    template <class Matrix> void init_with(const Matrix& matrix) {
        csc_matrix made(matrix.nrows(), matrix.ncols());
        matrix.for_each_entry([&](size_type /*i*/, size_type j, T /*value*/) { ++made.jc[j + 1]; });
        for (size_type j = 0; j < made.nc; ++j) {
            made.jc[j + 1] += made.jc[j];
        }
        made.pr.resize(made.jc.back());
        made.ir.resize(made.jc.back());
        // Rows or columns are visited in order, so that rows ascend within each column.
        std::vector<unsigned int> next(made.jc.begin(), made.jc.end() - 1);
        matrix.for_each_entry([&](size_type i, size_type j, T value) {
            made.ir[next[j]] = static_cast<unsigned int>(i);
            made.pr[next[j]++] = value;
        });
        *this = std::move(made);
    }
    template <class Matrix> void init_with_good_format(const Matrix& matrix) { init_with(matrix); }

    /// Calls `visit(i, j, value)` for each stored entry, column by column.
    template <class Visit> void for_each_entry(const Visit& visit) const {
        for (size_type j = 0; j < nc; ++j) {
            for (size_type k = jc[j]; k < jc[j + 1]; ++k) {
                visit(size_type(ir[k]), j, pr[k]);
            }
        }
    }
};

template <class T> struct is_matrix<csc_matrix<T>> : std::true_type {};

template <class T> size_type nnz(const csc_matrix<T>& matrix) {
    return matrix.pr.size();
}

} // namespace gmm

#endif
