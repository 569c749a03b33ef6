/// Matrices of sparse vectors, for writing.

#ifndef ROUNDEL_GMM_SHIM_MATRICES_H
#define ROUNDEL_GMM_SHIM_MATRICES_H

#include <gmm/shim/vectors.h>

#include <type_traits>
#include <vector>

namespace gmm {

/// A matrix whose rows are sparse vectors.
template <class Vector> class row_matrix {
  public:
    using value_type = typename Vector::value_type;
    using reference = typename Vector::reference;

    row_matrix() = default;
    row_matrix(size_type rows, size_type columns) : rows_(rows, Vector(columns)), cols_(columns) {}

    size_type nrows() const { return rows_.size(); }
    size_type ncols() const { return cols_; }

    reference operator()(size_type i, size_type j) { return rows_.at(i)[j]; }
    value_type operator()(size_type i, size_type j) const { return rows_.at(i)[j]; }

    Vector& row(size_type i) { return rows_.at(i); }
    const Vector& row(size_type i) const { return rows_.at(i); }
    Vector& operator[](size_type i) { return row(i); }
    const Vector& operator[](size_type i) const { return row(i); }

    void resize(size_type rows, size_type columns) {
        rows_.resize(rows, Vector(columns));
        for (Vector& row : rows_) {
            row.resize(columns);
        }
        cols_ = columns;
    }
    void clear_mat() {
        for (Vector& row : rows_) {
            row.clear();
        }
    }

    /// Calls `visit(i, j, value)` for each stored entry, row by row.
    template <class Visit> void for_each_entry(const Visit& visit) const {
        for (size_type i = 0; i < rows_.size(); ++i) {
            rows_[i].for_each_entry([&](size_type j, value_type value) { visit(i, j, value); });
        }
    }

  private:
    std::vector<Vector> rows_;
    size_type cols_ = 0;
};

/// A matrix whose columns are sparse vectors.
template <class Vector> class col_matrix {
  public:
    using value_type = typename Vector::value_type;
    using reference = typename Vector::reference;

    col_matrix() = default;
    col_matrix(size_type rows, size_type columns) : cols_(columns, Vector(rows)), rows_(rows) {}

    size_type nrows() const { return rows_; }
    size_type ncols() const { return cols_.size(); }

    reference operator()(size_type i, size_type j) { return cols_.at(j)[i]; }
    value_type operator()(size_type i, size_type j) const { return cols_.at(j)[i]; }

    Vector& col(size_type j) { return cols_.at(j); }
    const Vector& col(size_type j) const { return cols_.at(j); }
    Vector& operator[](size_type j) { return col(j); }
    const Vector& operator[](size_type j) const { return col(j); }

    void resize(size_type rows, size_type columns) {
        cols_.resize(columns, Vector(rows));
        for (Vector& col : cols_) {
            col.resize(rows);
        }
        rows_ = rows;
    }
    void clear_mat() {
        for (Vector& col : cols_) {
            col.clear();
        }
    }

    /// Calls `visit(i, j, value)` for each stored entry, column by column.
    template <class Visit> void for_each_entry(const Visit& visit) const {
        for (size_type j = 0; j < cols_.size(); ++j) {
            cols_[j].for_each_entry([&](size_type i, value_type value) { visit(i, j, value); });
        }
    }

  private:
    std::vector<Vector> cols_;
    size_type rows_ = 0;
};

/// Whether a type is a matrix; else it is a vector.
template <class Object> struct is_matrix : std::false_type {};
template <class Vector> struct is_matrix<row_matrix<Vector>> : std::true_type {};
template <class Vector> struct is_matrix<col_matrix<Vector>> : std::true_type {};

template <class Matrix> size_type mat_nrows(const Matrix& matrix) {
    return matrix.nrows();
}
template <class Matrix> size_type mat_ncols(const Matrix& matrix) {
    return matrix.ncols();
}

/// The number of stored entries.
template <class Vector> size_type nnz(const row_matrix<Vector>& matrix) {
    size_type count = 0;
    for (size_type i = 0; i < matrix.nrows(); ++i) {
        count += nnz(matrix.row(i));
    }
    return count;
}
template <class Vector> size_type nnz(const col_matrix<Vector>& matrix) {
    size_type count = 0;
    for (size_type j = 0; j < matrix.ncols(); ++j) {
        count += nnz(matrix.col(j));
    }
    return count;
}

template <class Matrix> void resize(Matrix& matrix, size_type rows, size_type columns) {
    matrix.resize(rows, columns);
}
template <class Vector> void clear(row_matrix<Vector>& matrix) {
    matrix.clear_mat();
}
template <class Vector> void clear(col_matrix<Vector>& matrix) {
    matrix.clear_mat();
}

} // namespace gmm

#endif
