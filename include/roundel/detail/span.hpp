/// Views of the caller's arrays: std::span where it exists, otherwise the part of it that is
/// needed.

#ifndef ROUNDEL_DETAIL_SPAN_HPP
#define ROUNDEL_DETAIL_SPAN_HPP

#include <cstddef>
#include <type_traits>
#include <utility>

#if defined(__has_include)
#if __has_include(<version>)
#include <version>
#endif
#endif

// The span in the signatures depends on the standard, and units of both standards may be linked
// into one program. The inline namespace gives their functions different names.
#if defined(__cpp_lib_span)
#include <span>
// clang-format off
#define ROUNDEL_NAMESPACE_BEGIN namespace roundel { inline namespace with_std_span {
#else
#define ROUNDEL_NAMESPACE_BEGIN namespace roundel { inline namespace with_own_span {
#endif
#define ROUNDEL_NAMESPACE_END } }
// clang-format on

ROUNDEL_NAMESPACE_BEGIN

#if defined(__cpp_lib_span)
template <class T> using span = std::span<T>;
#else
/// The part of std::span that this header needs, for C++17.
template <class T> class span {
  public:
    using element_type = T;
    using value_type = std::remove_cv_t<T>;
    using iterator = T*;

    constexpr span() noexcept = default;
    constexpr span(T* data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N> constexpr span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    /// A view of any contiguous container of T.
    template <class C,
              class = std::enable_if_t<std::is_convertible_v<
                  std::remove_pointer_t<decltype(std::declval<C&>().data())> (*)[], T (*)[]>>>
    constexpr span(C&& container) noexcept : data_(container.data()), size_(container.size()) {}

    constexpr T* data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T* begin() const noexcept { return data_; }
    constexpr T* end() const noexcept { return data_ + size_; }
    constexpr T& operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T& front() const noexcept { return data_[0]; }
    constexpr T& back() const noexcept { return data_[size_ - 1]; }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};
#endif

ROUNDEL_NAMESPACE_END

#endif // ROUNDEL_DETAIL_SPAN_HPP
