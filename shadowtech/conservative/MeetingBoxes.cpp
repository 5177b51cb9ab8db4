#include "shadowtech/conservative/MeetingBoxes.h"

#include <stdexcept>
#include <string>

namespace gnomon
{
namespace
{

void boxOf(const RTCBoundsFunctionArguments* of)
{
  const auto& boxes = *static_cast<const std::vector<Bounds>*>(of->geometryUserPtr);
  const glm::vec3 lower(boxes[of->primID].lower);
  const glm::vec3 upper(boxes[of->primID].upper);
  *of->bounds_o = { lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f };
}

/// Embree tells of each pair twice, and of each box with itself.
void visitPairs(void* visit, RTCCollision* pairs, unsigned int count)
{
  for (const RTCCollision* pair = pairs; pair != pairs + count; ++pair)
  {
    if (pair->primID0 < pair->primID1)
    {
      (*static_cast<const std::function<void(std::uint32_t, std::uint32_t)>*>(visit))(
        pair->primID0, pair->primID1);
    }
  }
}

} // namespace

//------------------------------------------------------------------------------
void MeetingBoxes::visit(
  const std::vector<Bounds>& boxes, const std::function<void(std::uint32_t, std::uint32_t)>& visit)
{
  if (boxes.size() < 2)
  {
    return; // Embree takes having none for a mistake
  }
  if (!this->device_.get())
  {
    this->device_ = EmbreeDevice(rtcNewDevice(nullptr));
  }
  const RTCDevice device = this->device_.get();
  if (!device)
  {
    throw std::runtime_error("Embree cannot be started on this machine");
  }
  const EmbreeScene scene(rtcNewScene(device));
  const EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned int>(boxes.size()));
  rtcSetGeometryUserData(geometry.get(), const_cast<std::vector<Bounds>*>(&boxes));
  rtcSetGeometryBoundsFunction(geometry.get(), boxOf, nullptr);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  rtcCollide(scene.get(), scene.get(), visitPairs,
    const_cast<std::function<void(std::uint32_t, std::uint32_t)>*>(&visit));
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
  {
    throw std::runtime_error(
      "Embree failed while looking for casters that are near each other: error " +
      std::to_string(static_cast<int>(error)));
  }
}

} // namespace gnomon
