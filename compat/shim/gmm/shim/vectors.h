/// Sparse vectors.

#ifndef ROUNDEL_GMM_SHIM_VECTORS_H
#define ROUNDEL_GMM_SHIM_VECTORS_H

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

    /// Calls `visit(index, value)` for each stored entry.
    template <class Visit> void for_each_entry(const Visit& visit) const {
        for (const auto& [index, value] : entries_) {
            visit(index, value);
        }
    }

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

template <class Vector> size_type vect_size(const Vector& vector) {
    return vector.size();
}

/// The number of stored entries.
template <class T> size_type nnz(const wsvector<T>& vector) {
    return vector.nb_stored();
}

template <class T> void clear(wsvector<T>& vector) {
    vector.clear();
}

} // namespace gmm

#endif
