/// Columns of matrices, and iterators over their stored entries that know the index of each.

#ifndef ROUNDEL_GMM_SHIM_COLUMNS_H
#define ROUNDEL_GMM_SHIM_COLUMNS_H

#include <gmm/shim/compressed.h>
#include <gmm/shim/matrices.h>
#include <gmm/shim/vectors.h>

#include <cstddef>
#include <iterator>

namespace gmm {

/// Visits the entries of a vector: `*it` is the value and `it.index()` its index.
template <class Vector> class sparse_iterator {
  public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = typename Vector::value_type;
    using difference_type = std::ptrdiff_t;
    using pointer = const value_type*;
    using reference = const value_type&;

    sparse_iterator() = default;
    explicit sparse_iterator(typename Vector::const_iterator at) : at_(at) {}

    size_type index() const { return at_->first; }
    reference operator*() const { return at_->second; }
    sparse_iterator& operator++() {
        ++at_;
        return *this;
    }
    sparse_iterator operator++(int) { return sparse_iterator(at_++); }
    bool operator==(const sparse_iterator& other) const { return at_ == other.at_; }
    bool operator!=(const sparse_iterator& other) const { return at_ != other.at_; }

  private:
    typename Vector::const_iterator at_;
};

/// The same for a column of a compressed matrix.
template <class T> class compressed_iterator {
  public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    compressed_iterator() = default;
    compressed_iterator(const csc_matrix<T>& matrix, size_type at) : matrix_(&matrix), at_(at) {}

    size_type index() const { return matrix_->ir[at_]; }
    reference operator*() const { return matrix_->pr[at_]; }
    compressed_iterator& operator++() {
        ++at_;
        return *this;
    }
    compressed_iterator operator++(int) { return compressed_iterator(*matrix_, at_++); }
    bool operator==(const compressed_iterator& other) const { return at_ == other.at_; }
    bool operator!=(const compressed_iterator& other) const { return at_ != other.at_; }

  private:
    const csc_matrix<T>* matrix_ = nullptr;
    size_type at_ = 0;
};

/// A column of a matrix, which must outlive it.
template <class Iterator> class sparse_column {
  public:
    using value_type = typename Iterator::value_type;
    using const_iterator = Iterator;

    sparse_column(Iterator begin, Iterator end, size_type size)
        : begin_(begin), end_(end), size_(size) {}

    size_type size() const { return size_; }
    const_iterator begin() const { return begin_; }
    const_iterator end() const { return end_; }

    /// Looks for an entry, one after the other.
    value_type operator[](size_type index) const {
        Iterator at = begin_;
        while (at != end_ && at.index() < index) {
            ++at;
        }
        return at == end_ || at.index() != index ? value_type(0) : *at;
    }

    template <class Visit> void for_each_entry(const Visit& visit) const {
        for (Iterator at = begin_; at != end_; ++at) {
            visit(at.index(), *at);
        }
    }

  private:
    Iterator begin_;
    Iterator end_;
    size_type size_;
};

/// The types by which programs declare columns and iterators over their entries.
template <class Object> struct linalg_traits { using value_type = typename Object::value_type; };
template <class T> struct linalg_traits<wsvector<T>> {
    using value_type = T;
    using const_iterator = sparse_iterator<wsvector<T>>;
};
template <class Iterator> struct linalg_traits<sparse_column<Iterator>> {
    using value_type = typename Iterator::value_type;
    using const_iterator = Iterator;
};
template <class Vector> struct linalg_traits<col_matrix<Vector>> {
    using value_type = typename Vector::value_type;
    using const_sub_col_type = sparse_column<sparse_iterator<Vector>>;
};
template <class T> struct linalg_traits<csc_matrix<T>> {
    using value_type = T;
    using const_sub_col_type = sparse_column<compressed_iterator<T>>;
};

/// The first entry of a sparse vector or a column.
template <class T> sparse_iterator<wsvector<T>> vect_const_begin(const wsvector<T>& vector) {
    return sparse_iterator<wsvector<T>>(vector.begin());
}
template <class Iterator> Iterator vect_const_begin(const sparse_column<Iterator>& column) {
    return column.begin();
}

/// The place after the last entry.
template <class T> sparse_iterator<wsvector<T>> vect_const_end(const wsvector<T>& vector) {
    return sparse_iterator<wsvector<T>>(vector.end());
}
template <class Iterator> Iterator vect_const_end(const sparse_column<Iterator>& column) {
    return column.end();
}

/// Column j of a matrix that stores columns.
template <class Vector>
sparse_column<sparse_iterator<Vector>> mat_const_col(const col_matrix<Vector>& matrix,
                                                     size_type j) {
    const Vector& column = matrix.col(j);
    return {vect_const_begin(column), vect_const_end(column), column.size()};
}
template <class T>
sparse_column<compressed_iterator<T>> mat_const_col(const csc_matrix<T>& matrix, size_type j) {
    return {{matrix, matrix.jc.at(j)}, {matrix, matrix.jc.at(j + 1)}, matrix.nr};
}

} // namespace gmm

#endif
