// How many members an aggregate has, so that a test notices one that the configuration forgot.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace redbee::test {

/// Turns into whatever a member is initialised with.
struct Anything {
  template <typename T>
  operator T() const;  // NOLINT(google-explicit-constructor): that is its purpose
};

template <typename Aggregate, typename Indices, typename = void>
struct IsBraceable : std::false_type {};
template <typename Aggregate, size_t... I>
struct IsBraceable<Aggregate, std::index_sequence<I...>,
                   std::void_t<decltype(Aggregate{(static_cast<void>(I), Anything{})...})>> : std::true_type {
};

/// Members of an aggregate of scalars, strings or other aggregates (no arrays).
template <typename Aggregate, size_t N = 0>
constexpr size_t fieldCount() {
  static_assert(std::is_aggregate_v<Aggregate>);
  if constexpr (IsBraceable<Aggregate, std::make_index_sequence<N + 1>>::value) {
    return fieldCount<Aggregate, N + 1>();
  } else {
    return N;
  }
}

}  // namespace redbee::test
