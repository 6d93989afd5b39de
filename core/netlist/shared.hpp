#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace rheonet {

/// A list shared by all its copies until one of them is changed (copy on write): the elements made by a `repeat` often have
/// the same values a million times.
template <class T>
class Shared {
 public:
  Shared() = default;
  Shared(std::vector<T> items) : kept_(items.empty() ? nullptr : std::make_shared<std::vector<T>>(std::move(items))) {}
  Shared(std::initializer_list<T> items) : Shared(std::vector<T>(items)) {}

  const std::vector<T>& items() const {
    static const std::vector<T> none;
    return kept_ ? *kept_ : none;
  }
  operator const std::vector<T>&() const { return items(); }
  std::size_t size() const { return items().size(); }
  bool empty() const { return !kept_ || kept_->empty(); }
  const T* data() const { return items().data(); }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return items()[i]; }
  const T& at(std::size_t i) const { return items().at(i); }
  const T& front() const { return items().front(); }
  const T& back() const { return items().back(); }

  /// The list, for changes: from now on this copy has a list of its own.
  std::vector<T>& own() {
    if (!kept_ || kept_.use_count() > 1) kept_ = std::make_shared<std::vector<T>>(items());
    return *kept_;
  }

  friend bool operator==(const Shared& one, const Shared& other) { return one.items() == other.items(); }

 private:
  std::shared_ptr<std::vector<T>> kept_;  ///< nullptr: no items
};

}  // namespace rheonet
