/// Matrices and vectors seen transposed or scaled, without a copy.

#ifndef ROUNDEL_GMM_SHIM_VIEWS_H
#define ROUNDEL_GMM_SHIM_VIEWS_H

#include <gmm/shim/matrices.h>
#include <gmm/shim/vectors.h>

#include <type_traits>
#include <vector>

namespace gmm {

/// Calls `visit(index, value)` for each entry of a vector, of a dense one too.
template <class Vector, class Visit> void visit_vector(const Vector& vector, const Visit& visit) {
    vector.for_each_entry(visit);
}
template <class T, class Visit>
void visit_vector(const std::vector<T>& vector, const Visit& visit) {
    for (size_type i = 0; i < vector.size(); ++i) {
        visit(i, vector[i]);
    }
}

/// A matrix seen transposed. The matrix must outlive it, as for all views.
template <class Matrix> class transposed_view {
  public:
    using value_type = typename Matrix::value_type;

    explicit transposed_view(const Matrix& matrix) : matrix_(matrix) {}

    size_type nrows() const { return matrix_.ncols(); }
    size_type ncols() const { return matrix_.nrows(); }
    value_type operator()(size_type i, size_type j) const { return matrix_(j, i); }

    template <class Visit> void for_each_entry(const Visit& visit) const {
        matrix_.for_each_entry(
            [&](size_type i, size_type j, value_type value) { visit(j, i, value); });
    }

  private:
    const Matrix& matrix_;
};

template <class Matrix> struct is_matrix<transposed_view<Matrix>> : std::true_type {};

/// A matrix or a vector seen with all its entries multiplied by a factor.
template <class Object> class scaled_view {
  public:
    using value_type = typename Object::value_type;

    scaled_view(const Object& object, value_type factor) : object_(object), factor_(factor) {}

    size_type nrows() const { return object_.nrows(); }
    size_type ncols() const { return object_.ncols(); }
    size_type size() const { return object_.size(); }
    value_type operator()(size_type i, size_type j) const { return factor_ * object_(i, j); }
    value_type operator[](size_type index) const { return factor_ * object_[index]; }

    template <class Visit> void for_each_entry(const Visit& visit) const {
        if constexpr (is_matrix<Object>::value) {
            object_.for_each_entry(
                [&](size_type i, size_type j, value_type value) { visit(i, j, factor_ * value); });
        } else {
            visit_vector(object_,
                         [&](size_type index, value_type value) { visit(index, factor_ * value); });
        }
    }

  private:
    const Object& object_;
    value_type factor_;
};

template <class Object> struct is_matrix<scaled_view<Object>> : is_matrix<Object> {};

template <class Matrix> transposed_view<Matrix> transposed(const Matrix& matrix) {
    return transposed_view<Matrix>(matrix);
}

template <class Object, class Factor>
scaled_view<Object> scaled(const Object& object, Factor factor) {
    return {object, static_cast<typename Object::value_type>(factor)};
}

} // namespace gmm

#endif
