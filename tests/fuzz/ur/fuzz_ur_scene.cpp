// Fuzzes pipeline files as the emulator reads its surroundings from them.
#include "sim_plant/ur/scene/scene_reader.hpp"
#include "tests/fuzz/fuzzing.hpp"

using namespace tactus;
using namespace tactus::ur;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static SceneReader reader;
  Surroundings around;
  LoadError error;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (reader.read(text, around, error) != Status::kOk) {
    MUST(!std::string_view(error.reason).empty());
    return 0;
  }
  MUST(around.payload_com.allFinite() && around.tip.allFinite() && around.payload_kg >= 0.0);
  MUST(around.scene.count >= 0 && around.scene.count <= kMaxBoxes);
  for (int i = 0; i < around.scene.count; ++i) {
    const Box& box = around.scene.boxes[static_cast<std::size_t>(i)];
    MUST(box.pose.p.allFinite() && box.pose.r.coeffs().allFinite());
    MUST((box.half_extents.array() > 0.0).all());
  }
  return 0;
}
