#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace raylane::core {

template <class Signature>
class FunctionRef;

/// Non-owning reference to a callable, for functions that are compiled once instead of once per
/// callable. It must not outlive the callable.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
  public:
    template <class Callable>
    requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
        FunctionRef(const Callable& callable) // NOLINT: implicit
        : callable_(std::addressof(callable)), call_([](const void* of, Arguments... arguments) {
              return (*static_cast<const Callable*>(of))(std::forward<Arguments>(arguments)...);
          }) {}

    Result operator()(Arguments... arguments) const {
        return call_(callable_, std::forward<Arguments>(arguments)...);
    }

  private:
    const void* callable_;
    Result (*call_)(const void*, Arguments...);
};

} // namespace raylane::core
