// SPDX-License-Identifier: Apache-2.0
#include "path/profile_observer.h"

#include <string>

namespace brdf::render {

class ProfileObservers::Recorder final : public PathObserver {
 public:
  Recorder(std::vector<std::string> slots, int spp) : recorder(std::move(slots)), of_pixel_(1.0 / spp) {}

  void query(const MaterialQuery& q) noexcept override {
    if ((q.operations & query_eval) != 0) recorder.count(q.slot, ProfileOperation::eval);
    if ((q.operations & query_pdf) != 0) recorder.count(q.slot, ProfileOperation::pdf);
    if ((q.operations & query_sample) != 0) recorder.count(q.slot, ProfileOperation::sample);
    if ((q.flags & sample_transmission) != 0) recorder.count(q.slot, ProfileOperation::transmission);
    recorder.add(q.slot, profile_place(q.wi, q.wo), static_cast<double>(q.contribution) * of_pixel_);
    if (q.pixels > 0) recorder.first_hit(q.slot, static_cast<double>(q.pixels) * of_pixel_);
  }

  ProfileRecorder recorder;

 private:
  double of_pixel_;
};

ProfileObservers::ProfileObservers(const Scene& scene, const RenderOptions& options) {
  std::vector<std::string> slots;
  for (const MaterialSlot& slot : scene.materials) slots.push_back(slot.name);
  for (int i = 0; i < render_threads(options.threads); ++i) {
    recorders_.push_back(std::make_unique<Recorder>(slots, options.spp));
    pointers_.push_back(recorders_.back().get());
  }
}

ProfileObservers::~ProfileObservers() = default;

Profile ProfileObservers::profile() const {
  Profile sum;
  for (const auto& r : recorders_) sum.merge(r->recorder.profile());
  std::erase_if(sum.materials, [](const auto& m) { return m.second == MaterialProfile(); });
  return sum;
}

}  // namespace brdf::render
