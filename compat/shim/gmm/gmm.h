/// A stand-in for the part of GMM++'s interface that programs for CoMISo use: sparse matrices that
/// are filled entry by entry. It contains no code of GMM++.
///
/// If the real GMM++ was included before, this file is empty. To use the real one instead, leave
/// this directory out of the include path (see docs/comiso.md).

#if !defined(GMM_KERNEL_H__) && !defined(ROUNDEL_GMM_SHIM)
#define ROUNDEL_GMM_SHIM 1

#include <cstddef>
#include <map>
#include <stdexcept>
#include <vector>

namespace gmm {

using size_type = std::size_t;

/// An entry of a sparse vector, which converts to a number and accepts assignments.
template <class Vector> class element {
  public:
    using value_type = typename Vector::value_type;

    element(Vector& vector, size_type index) : vector_(&vector), index_(index) {}
    element(const element&) = default;

    operator value_type() const { return vector_->r(index_); }

    element& operator=(value_type value) {
        vector_->w(index_, value);
        return *this;
    }
    /// Assigns the value of the other entry, not its place.
    element& operator=(const element& other) { return *this = value_type(other); }
    element& operator+=(value_type value) { return *this = value_type(*this) + value; }
    element& operator-=(value_type value) { return *this = value_type(*this) - value; }
    element& operator*=(value_type value) { return *this = value_type(*this) * value; }
    element& operator/=(value_type value) { return *this = value_type(*this) / value; }

  private:
    Vector* vector_;
    size_type index_;
};

/// A sparse vector for writing. Zeros are not stored.
template <class T> class wsvector {
  public:
    using value_type = T;
    using reference = element<wsvector>;
    using const_iterator = typename std::map<size_type, T>::const_iterator;

    wsvector() = default;
    explicit wsvector(size_type size) : size_(size) {}

    size_type size() const { return size_; }
    size_type nb_stored() const { return entries_.size(); }
    /// Entries beyond the new size are lost.
    void resize(size_type size) {
        entries_.erase(entries_.lower_bound(size), entries_.end());
        size_ = size;
    }
    void clear() { entries_.clear(); }

    reference operator[](size_type index) { return reference(*this, index); }
    T operator[](size_type index) const { return r(index); }

    /// Reads an entry.
    T r(size_type index) const {
        check(index);
        const auto found = entries_.find(index);
        return found == entries_.end() ? T(0) : found->second;
    }
    /// Writes an entry.
    void w(size_type index, T value) {
        check(index);
        if (value == T(0)) {
            entries_.erase(index);
        } else {
            entries_[index] = value;
        }
    }

    /// The stored entries: pairs of index and value in the order of their indices.
    const_iterator begin() const { return entries_.begin(); }
    const_iterator end() const { return entries_.end(); }

  private:
    void check(size_type index) const {
        if (index >= size_) {
            throw std::out_of_range("gmm: an index is out of range");
        }
    }

    std::map<size_type, T> entries_;
    size_type size_ = 0;
};

/// A sparse vector for reading; here the same type.
template <class T> using rsvector = wsvector<T>;

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

  private:
    std::vector<Vector> cols_;
    size_type rows_ = 0;
};

/// The matrices that the functions below accept.
template <class Matrix> struct is_shim_matrix { static constexpr bool value = false; };
template <class Vector> struct is_shim_matrix<row_matrix<Vector>> {
    static constexpr bool value = true;
};
template <class Vector> struct is_shim_matrix<col_matrix<Vector>> {
    static constexpr bool value = true;
};

template <class Matrix> size_type mat_nrows(const Matrix& matrix) {
    return matrix.nrows();
}
template <class Matrix> size_type mat_ncols(const Matrix& matrix) {
    return matrix.ncols();
}
template <class Vector> size_type vect_size(const Vector& vector) {
    return vector.size();
}

/// The number of stored entries.
template <class T> size_type nnz(const wsvector<T>& vector) {
    return vector.nb_stored();
}
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
template <class T> void clear(wsvector<T>& vector) {
    vector.clear();
}
template <class Vector> void clear(row_matrix<Vector>& matrix) {
    matrix.clear_mat();
}
template <class Vector> void clear(col_matrix<Vector>& matrix) {
    matrix.clear_mat();
}

} // namespace gmm

#endif
