// SPDX-License-Identifier: Apache-2.0
#include "path/render_scene.h"

#include <brdf/error.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <thread>
#include <vector>

namespace brdf::render {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int tile = 16;
constexpr int max_spp = 1 << 20;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void check(const Scene& scene, const RenderOptions& o, std::span<const Surface> surfaces, std::span<PathObserver* const> observers) {
  const auto bad = [](const std::string& what) { throw Error(ErrorCode::invalid_argument, what); };
  if (o.spp < 1 || o.spp > max_spp) bad("spp is " + std::to_string(o.spp) + ", allowed is 1 to " + std::to_string(max_spp));
  if (o.threads < 0 || o.threads > 1024) bad("threads is " + std::to_string(o.threads) + ", allowed is 0 to 1024");
  if (!surfaces.empty() && surfaces.size() != scene.materials.size()) bad("surfaces must be as many as the scene has materials");
  if (!observers.empty() && observers.size() < static_cast<std::size_t>(render_threads(o.threads))) bad("fewer observers than threads");
}

/// One run of some samples over every tile.
class Pass {
 public:
  Pass(const Scene& scene, const PathTracer& tracer, std::uint64_t seed, int first, int count, Film& film) noexcept
      : scene_(scene), tracer_(tracer), seed_(seed), first_(first), count_(count), film_(film) {}

  int tiles() const noexcept { return columns() * ((film_.height() + tile - 1) / tile); }
  int done() const noexcept { return done_.load(std::memory_order_relaxed); }
  void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }

  void work(PathCounts& counts, PathObserver* observer) noexcept {
    for (int i = next_++; i < tiles() && !stopped_.load(std::memory_order_relaxed); i = next_++) {
      render_tile(i, counts, observer);
      ++done_;
    }
  }

 private:
  int columns() const noexcept { return (film_.width() + tile - 1) / tile; }

  void render_tile(int i, PathCounts& counts, PathObserver* observer) noexcept {
    const int left = i % columns() * tile, top = i / columns() * tile;
    const int columns = std::min(tile, film_.width() - left), rows = std::min(tile, film_.height() - top);
    // samples of a tile in the order of pixels, as many at a time as the tracer takes
    std::array<PathTracer::Path, PathTracer::most_paths> paths;
    std::array<Film::Pixel*, PathTracer::most_paths> pixels;
    std::size_t size = 0;
    const auto flush = [&] {
      tracer_.trace(std::span(paths).first(size), counts, observer);
      for (std::size_t k = 0; k < size; ++k) pixels[k]->add(paths[k].radiance);
      size = 0;
    };
    for (int y = top; y < top + rows; ++y) {
      for (int x = left; x < left + columns; ++x) {
        const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(film_.width()) + static_cast<std::uint64_t>(x);
        for (int s = first_; s < first_ + count_; ++s) {
          Random random(seed_, index, static_cast<std::uint64_t>(s));
          const glm::vec2 jitter = random.next2();
          paths[size] = {};
          paths[size].ray = scene_.camera.ray(static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y);
          paths[size].random = random;
          pixels[size] = &film_.at(x, y);
          if (++size == paths.size()) flush();
        }
      }
    }
    if (size > 0) flush();
  }

  const Scene& scene_;
  const PathTracer& tracer_;
  std::uint64_t seed_;
  int first_, count_;
  Film& film_;
  std::atomic<int> next_{0}, done_{0};
  std::atomic<bool> stopped_{false};
};

/// Calls back now and then, however short or long passes are.
class Reporter {
 public:
  explicit Reporter(const Progress& progress) : progress_(progress) {}
  static constexpr std::chrono::milliseconds interval{100};

  /// Whether to go on.
  bool report(double done) {
    if (!progress_ || cancelled_ || Clock::now() - last_ < interval) return !cancelled_;
    cancelled_ = !progress_("rendering", done);
    last_ = Clock::now();
    return !cancelled_;
  }

 private:
  const Progress& progress_;
  Clock::time_point last_ = Clock::now();
  bool cancelled_ = false;
};

/// Runs a pass on `threads` threads besides this one, which reports. False when it was cancelled.
bool run(Pass& pass, int threads, double begin, double end, Reporter& reporter, PathCounts& counts,
         std::span<PathObserver* const> observers) {
  std::mutex mutex;
  std::condition_variable finished;
  int running = threads;
  std::vector<PathCounts> of_thread(static_cast<std::size_t>(threads));
  bool goes_on = true;
  {
    std::vector<std::jthread> workers;
    for (int t = 0; t < threads; ++t) {
      workers.emplace_back([&, t] {
        const auto i = static_cast<std::size_t>(t);
        pass.work(of_thread[i], observers.empty() ? nullptr : observers[i]);
        const std::lock_guard lock(mutex);
        if (--running == 0) finished.notify_one();
      });
    }
    std::unique_lock lock(mutex);
    while (!finished.wait_for(lock, Reporter::interval, [&] { return running == 0; })) {
      lock.unlock();
      goes_on = reporter.report(begin + (end - begin) * pass.done() / pass.tiles());
      if (!goes_on) pass.stop();
      lock.lock();
    }
  }
  for (const PathCounts& c : of_thread) counts += c;
  return goes_on && reporter.report(end);
}

}  // namespace

int render_threads(int wanted) noexcept {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

RenderResult render_scene(const Scene& scene, const RenderOptions& options, const Progress& progress, std::span<const Surface> surfaces,
                          std::span<PathObserver* const> observers) {
  check(scene, options, surfaces, observers);
  std::vector<Surface> own;
  if (surfaces.empty()) {
    own = surfaces_for(scene, options.sampling);
    surfaces = own;
  }
  const PathTracer tracer(scene, surfaces, options.sampling);
  RenderResult result;
  result.film = Film(scene.description.film.width, scene.description.film.height);
  result.threads = render_threads(options.threads);
  const Clock::time_point start = Clock::now();
  const std::clock_t processor_start = std::clock();
  Reporter reporter(progress);
  // The first passes are short, so that an early interruption finds a whole picture; later ones spare the waiting for the last tile,
  // and small pictures the starting of threads.
  const std::int64_t pixels = static_cast<std::int64_t>(result.film.width()) * result.film.height();
  const int longest = static_cast<int>(std::clamp<std::int64_t>((1 << 20) / pixels, 16, 1024));
  for (int first = 0, count = 1; first < options.spp; first += count, count = std::min(count * 2, longest)) {
    count = std::min(count, options.spp - first);
    Pass pass(scene, tracer, options.seed, first, count, result.film);
    const double spp = options.spp;
    if (!run(pass, result.threads, first / spp, (first + count) / spp, reporter, result.counts, observers)) {
      result.complete = first + count == options.spp && result.film.fewest_samples() == static_cast<std::uint32_t>(options.spp);
      break;
    }
    result.complete = first + count == options.spp;
    if (options.seconds > 0 && seconds_since(start) >= options.seconds) {
      result.complete = true;
      break;
    }
  }
  result.seconds = seconds_since(start);
  result.processor_seconds = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace brdf::render
