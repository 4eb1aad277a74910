#include "simd/stream_tracer.hpp"

#include "simd/stream/worker.hpp"
#include "simd/threads.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace raylane::simd {

/// A worker as long as it is used.
class StreamTracer::Lease {
  public:
    explicit Lease(const StreamTracer& tracer) : tracer_(tracer) {
        {
            const std::lock_guard lock(tracer.mutex_);
            if (!tracer.idle_.empty()) {
                worker_ = std::move(tracer.idle_.back());
                tracer.idle_.pop_back();
            }
        }
        if (worker_ == nullptr)
            worker_ =
                std::make_unique<StreamWorker>(*tracer.data_, tracer.tracing_, tracer.shapes_);
    }
    ~Lease() {
        const std::lock_guard lock(tracer_.mutex_);
        try {
            tracer_.idle_.push_back(std::move(worker_));
        } catch (const std::bad_alloc&) { // one less to keep
        }
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    StreamWorker& operator*() const { return *worker_; }

  private:
    const StreamTracer& tracer_;
    std::unique_ptr<StreamWorker> worker_;
};

StreamTracer::StreamTracer(const core::Scene& scene, int threads, Isa isa,
                           core::Precision precision)
    : threads_(threads), data_(std::make_unique<const SceneData>(scene, Transmissive::blocks)),
      tracing_{&kernels_of(isa), precision}, shapes_(*data_) {}

StreamTracer::~StreamTracer() = default;

/// Calls answer(worker, first, count) for ranges that together are all rays.
template <class Answer>
void StreamTracer::answer(std::size_t count, const Answer& answer) const {
    if (count == 0) return;
    // All threads get some of what there is.
    const int threads = threads_ > 0 ? threads_ : default_threads();
    const std::size_t share = count / (std::size_t{4} * static_cast<std::size_t>(threads));
    const std::size_t range = std::max(share / fewest * fewest, fewest);
    if (threads == 1 || count <= range) {
        const Lease worker(*this);
        answer(*worker, 0, count);
        return;
    }
    on_threads(threads_, [&] {
        parallel_for((count + range - 1) / range, [&](std::size_t number) {
            const Lease worker(*this);
            const std::size_t first = number * range;
            answer(*worker, first, std::min(range, count - first));
        });
    });
}

template <class Real>
void StreamTracer::nearest(const RayStream<Real>& rays, const HitStream& hits) const {
    answer(rays.count, [&](StreamWorker& worker, std::size_t first, std::size_t count) {
        worker.nearest(part_of(rays, first, count), part_of(hits, first));
    });
}

template <class Real>
void StreamTracer::occluded(const RayStream<Real>& rays, std::uint8_t* occluded) const {
    answer(rays.count, [&](StreamWorker& worker, std::size_t first, std::size_t count) {
        worker.occluded(part_of(rays, first, count), occluded + first);
    });
}

template void StreamTracer::nearest(const RayStream<float>&, const HitStream&) const;
template void StreamTracer::nearest(const RayStream<double>&, const HitStream&) const;
template void StreamTracer::occluded(const RayStream<float>&, std::uint8_t*) const;
template void StreamTracer::occluded(const RayStream<double>&, std::uint8_t*) const;

} // namespace raylane::simd
