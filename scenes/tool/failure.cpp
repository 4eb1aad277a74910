#include "scenes/tool/failure.hpp"

#include "core/shapes/invalid_value.hpp"
#include "scenes/errors.hpp"
#include "scenes/tool/checkpoint/resumable.hpp"
#include "scenes/tool/ranks/job.hpp"

#include <exception>
#include <new>

namespace raylane::scenes {

Failure failure_being_handled() {
    try {
        throw;
    } catch (const BadInput& error) {
        return {bad_input, error.what()};
    } catch (const core::InvalidValue& error) {
        return {bad_input, error.what()};
    } catch (const Stopped& stopped) {
        return {128 + stopped.signal, stopped.what()};
    } catch (const RankFailed& failed) {
        return {failed.code, failed.what()};
    } catch (const std::bad_alloc&) {
        return {refused, "not enough memory"};
    } catch (const std::exception& error) {
        return {refused, error.what()};
    }
}

} // namespace raylane::scenes
