// Number of members of an aggregate, to find members without a configuration key.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace redbee::test {

/// Converts to the type of any member.
struct Anything {
  template <typename T>
  operator T() const;  // NOLINT(google-explicit-constructor): must be implicit
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
