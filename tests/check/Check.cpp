#include "Check.h"

#include "Tracer.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfVecAttribute.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace gnomon::check
{

namespace
{

constexpr double pi = 3.14159265358979323846;

/// Rasterisers place corners to 1/256 of a pixel. A sample may lie twice that off a pixel's centre.
constexpr double lookingPixels = 1.0 / 128.0;

/// A position in float lies off its triangle by no more than this share of the distance.
constexpr double storedPrecision = 1e-6;

/// Unit normals further apart (about 0.1 degrees) belong to different surfaces.
constexpr double sameNormalDistance = 0.002;

/// Makes rays through the points of a picture.
class CameraRays
{
public:
  CameraRays(const Camera& camera, int width, int height)
    : position_(camera.position)
    , forward_((camera.target - camera.position).normalized())
    , width_(width)
    , height_(height)
  {
    const double tangent = std::tan(camera.fovDegrees * pi / 360.0);
    const Vec3 right = this->forward_.cross(camera.up).normalized();
    this->right_ = tangent * width / height * right;
    this->up_ = tangent * right.cross(this->forward_);
  }

  /// @param x,y in pixels from the upper left corner
  Ray through(double x, double y) const
  {
    const double across = 2.0 * x / this->width_ - 1.0;
    const double upward = 1.0 - 2.0 * y / this->height_;
    return { this->position_,
      (this->forward_ + across * this->right_ + upward * this->up_).normalized() };
  }

  /// Return the angle that a pixel in the middle of the picture covers, in radians.
  double pixelAngle() const { return 2.0 * this->up_.length() / this->height_; }

private:
  Vec3 position_;
  Vec3 forward_;
  Vec3 right_; ///< to the right border
  Vec3 up_;    ///< to the upper border
  int width_;
  int height_;
};

/// Return the unit normal on the side from which the corners are counter-clockwise.
Vec3 frontOf(const Triangle& triangle)
{
  return (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
}

/// A visible point and the normal on the camera's side.
struct Point
{
  Hit hit;
  Vec3 normal; ///< unit
};

/// Offset of the shadow ray's start from the surface: above the rounding of double precision, and
/// much less than a pixel.
double offsetOf(const Point& point)
{
  return 1e-13 * point.hit.position.length() + 1e-10 * point.hit.distance;
}

/// Return the ray that decides whether the light arrives; none for points that are turned away or
/// outside the cone or box.
std::optional<Ray> shadowRay(const Light& light, const Point& point)
{
  const Vec3 origin = point.hit.position + offsetOf(point) * point.normal;
  Ray ray{ origin, -light.direction };
  const Vec3 toLight = light.position - origin;
  if (light.kind != Light::Kind::Directional)
  {
    ray.direction = toLight.normalized();
    ray.length = toLight.length();
  }
  if (light.kind == Light::Kind::Spot &&
    -ray.direction.dot(light.direction) < std::cos(light.coneAngleDegrees * pi / 180.0))
  {
    return std::nullopt;
  }
  if (light.box)
  {
    const Vec3 right = light.box->up.cross(light.direction).normalized();
    const Vec3 up = light.direction.cross(right);
    ray.length = -toLight.dot(light.direction); // to the near face, where the light begins
    if (std::abs(toLight.dot(right)) > 0.5 * light.box->width ||
      std::abs(toLight.dot(up)) > 0.5 * light.box->height || ray.length < 0.0 ||
      ray.length > light.box->depth)
    {
      return std::nullopt;
    }
  }
  return point.normal.dot(ray.direction) > tolerance::facingCosine ? std::optional(ray)
                                                                   : std::nullopt;
}

/// Findings about one light in one pixel.
struct LightVerdict
{
  bool isReached = false; ///< a ray decides
  bool isLit = false;     ///< in truth
  bool isWrong = false;
};

/// Findings about one pixel.
struct PixelResult
{
  bool coverageDiffers = false;
  bool covered = false; ///< in the file and in truth
  double positionError = 0.0;
  bool otherSurface = false;
  bool otherFace = false;
  bool normalDiffers = false;
  std::vector<LightVerdict> lights;
};

/// Compares pixel by pixel.
class Comparison
{
public:
  Comparison(const Scene& scene, const VisibilityFile& file)
    : scene_(scene)
    , file_(file)
    , coverage_(file.channel("coverage"))
    , tracer_(scene)
    , camera_(scene.camera, file.width, file.height)
  {
    for (std::size_t light = 0; light < scene.lights.size(); ++light)
    {
      this->visibility_.push_back(&file.channel("visibility." + std::to_string(light)));
    }
  }

  PixelResult compare(std::size_t pixel) const
  {
    const auto width = static_cast<std::size_t>(this->file_.width);
    const double x = static_cast<double>(pixel % width) + 0.5;
    const double y = static_cast<double>(pixel / width) + 0.5;
    const std::optional<Point> truth = this->look(x, y);
    const bool coveredInFile = this->coverage_[pixel] > 0.5f;
    PixelResult result;
    result.coverageDiffers = coveredInFile != truth.has_value();
    result.covered = coveredInFile && truth;
    if (result.covered)
    {
      const Point drawn = this->compareSurface(pixel, x, y, *truth, result);
      for (std::size_t light = 0; light < this->scene_.lights.size(); ++light)
      {
        result.lights.push_back(this->compareLight(light, pixel, drawn));
      }
    }
    return result;
  }

private:
  std::optional<Point> look(double x, double y) const
  {
    const Ray ray = this->camera_.through(x, y);
    const std::optional<Hit> hit = this->tracer_.nearest(ray);
    if (!hit)
    {
      return std::nullopt;
    }
    const Vec3 normal = frontOf(this->triangleOf(*hit));
    return Point{ *hit, normal.dot(ray.direction) > 0.0 ? -normal : normal };
  }

  /// Return a stored position's error as a share of its distance from the camera; infinite for NaN.
  static double positionError(const Vec3& position, const Point& truth)
  {
    const double error = (position - truth.hit.position).length() / truth.hit.distance;
    return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
  }

  /// True if a position lies on a triangle other than the truth's, within the tolerance. The
  /// pixel's ray must meet or nearly pass it there. A camera ray that a rasteriser cannot tell from
  /// the pixel's must see that triangle first.
  bool onOtherSurface(const Vec3& position, double x, double y, const Point& truth) const
  {
    const Ray ray = this->camera_.through(x, y);
    const double distance = (position - ray.origin).length();
    const double nearby = tolerance::positionError * distance;
    if (!this->looksAt(ray, position))
    {
      return false;
    }
    const Triangle* const truthTriangle = &this->triangleOf(truth.hit);
    // Triangles seen edge-on are thin strips, so this many rays are needed.
    constexpr int around = 64;
    constexpr int circles = 4;
    for (int i = 0; i < around; ++i)
    {
      const double angle = 2.0 * pi * i / around;
      const double radius = lookingPixels * (i % circles + 1) / circles;
      const std::optional<Hit> hit = this->tracer_.nearest(
        this->camera_.through(x + radius * std::cos(angle), y + radius * std::sin(angle)));
      const Triangle* const other = hit ? &this->triangleOf(*hit) : truthTriangle;
      if (other == truthTriangle || (position - nearestPoint(position, *other)).length() > nearby)
      {
        continue;
      }
      const std::optional<double> met = intersect(ray, *other);
      if (!met || std::abs(*met - distance) <= nearby)
      {
        return true;
      }
    }
    return false;
  }

  /// True if a camera ray passes a point more closely than a rasteriser can tell.
  bool looksAt(const Ray& ray, const Vec3& point) const
  {
    const Vec3 view = point - ray.origin;
    const double looking = lookingPixels * this->camera_.pixelAngle() * view.length();
    return view.cross(ray.direction).length() <= looking + storedPrecision * view.length();
  }

  /// Return the point of the triangle to which a position and a normal on the camera's side belong.
  /// It is the nearest within the tolerance. None if the pixel's ray passes it farther than a
  /// rasteriser can tell.
  std::optional<Point> drawn(const Vec3& position, const Vec3& normal, double x, double y) const
  {
    const Ray ray = this->camera_.through(x, y);
    const double distance = (position - ray.origin).length();
    const std::optional<Hit> hit =
      this->tracer_.nearestTo(position, tolerance::positionError * distance,
        [&](const Triangle& triangle)
        {
          const Vec3 front = frontOf(triangle);
          return (sameNormal(normal, front) || sameNormal(normal, -front)) &&
            this->looksAt(ray, nearestPoint(position, triangle));
        });
    if (!hit || normal.dot(position - ray.origin) > 0.0)
    {
      return std::nullopt;
    }
    // An edge belongs to both of its faces. Move the point into this face by the precision of
    // stored positions.
    const Triangle& triangle = this->triangleOf(*hit);
    const Vec3 inwards = (triangle[0] + triangle[1] + triangle[2]) / 3.0 - hit->position;
    const double length = inwards.length();
    const Vec3 inside =
      hit->position + std::min(storedPrecision * distance / length, 0.5) * inwards;
    const Vec3 front = frontOf(triangle);
    return Point{ { inside, distance, hit->surface, hit->triangle },
      sameNormal(normal, front) ? front : -front };
  }

  const Triangle& triangleOf(const Hit& hit) const
  {
    return this->scene_.surfaces[hit.surface].triangles[hit.triangle];
  }

  static bool sameNormal(const Vec3& a, const Vec3& b)
  {
    return (a - b).length() <= sameNormalDistance; // false for NaN
  }

  /// Compare position and normal. Where they differ from those at the pixel's centre, they may
  /// belong to another triangle that a rasteriser finds there.
  /// @return the point whose visibility the file states
  Point compareSurface(
    std::size_t pixel, double x, double y, const Point& truth, PixelResult& result) const
  {
    const Vec3 position = this->file_.origin + this->file_.vector("position", pixel);
    const Vec3 normal = this->file_.vector("normal", pixel);
    result.positionError = positionError(position, truth);
    result.normalDiffers = !sameNormal(normal, truth.normal);
    const bool elsewhere = result.positionError > tolerance::positionError;
    if ((!elsewhere && !result.normalDiffers) || !std::isfinite(result.positionError))
    {
      return truth;
    }
    const std::optional<Point> drawn = this->drawn(position, normal, x, y);
    result.otherSurface = elsewhere && this->onOtherSurface(position, x, y, truth);
    result.otherFace = !elsewhere && drawn;
    result.normalDiffers = result.normalDiffers && !drawn;
    return drawn && (result.otherSurface || result.otherFace) ? *drawn : truth;
  }

  LightVerdict compareLight(std::size_t light, std::size_t pixel, const Point& drawn) const
  {
    const double value = static_cast<double>((*this->visibility_[light])[pixel]);
    const std::optional<Ray> ray = shadowRay(this->scene_.lights[light], drawn);
    const bool receives = this->scene_.surfaces[drawn.hit.surface].receives;
    const bool isLit = ray && (!receives || !this->tracer_.blocked(*ray));
    const bool isRight =
      std::abs(value - (isLit ? 1.0 : 0.0)) <= tolerance::visibilityDifference; // false for NaN
    return { ray.has_value(), isLit, !isRight && (ray || receives) };
  }

  const Scene& scene_;
  const VisibilityFile& file_;
  const std::vector<float>& coverage_;
  std::vector<const std::vector<float>*> visibility_;
  Tracer tracer_;
  CameraRays camera_;
};

void add(Result& result, std::size_t pixel, const PixelResult& found)
{
  const auto listIf = [pixel](bool isListed, Pixels& list)
  {
    if (isListed)
    {
      list.push_back(pixel);
    }
  };
  listIf(found.coverageDiffers, result.coverage);
  if (!found.covered)
  {
    return;
  }
  ++result.covered;
  listIf(found.otherSurface, result.otherSurface);
  if (!found.otherSurface)
  {
    listIf(found.positionError > tolerance::positionError, result.position);
    result.positionError = std::max(result.positionError, found.positionError);
  }
  listIf(found.otherFace, result.otherFace);
  listIf(found.normalDiffers, result.normal);
  for (std::size_t i = 0; i < found.lights.size(); ++i)
  {
    const auto& [isReached, isLit, isWrong] = found.lights[i];
    LightResult& light = result.lights[i];
    light.counted += isReached ? 1 : 0;
    listIf(isWrong, !isReached ? light.unlit : isLit ? light.falseShadow : light.falseLight);
  }
}

double share(std::size_t part, std::size_t whole)
{
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

} // namespace

std::vector<std::string> Result::failures(int width) const
{
  std::vector<std::string> sentences;
  const auto require =
    [&](const std::string& what, double value, double limit, const std::vector<Pixels>& where)
  {
    if (!(value <= limit))
    {
      std::ostringstream sentence;
      sentence << what << ": " << value << ", expected at most " << limit << "; at";
      for (const Pixels& pixels : where)
      {
        for (std::size_t i = 0; i < std::min<std::size_t>(pixels.size(), 5); ++i)
        {
          const auto columns = static_cast<std::size_t>(width);
          sentence << " (" << pixels[i] % columns << ", " << pixels[i] / columns << ")";
        }
      }
      sentences.push_back(sentence.str());
    }
  };
  if (this->covered == 0)
  {
    sentences.emplace_back("no pixel is covered in the file and in truth");
  }
  require("share of pixels whose coverage differs",
    share(this->coverage.size() + this->otherSurface.size(), this->pixels),
    tolerance::coverageShare, { this->coverage, this->otherSurface });
  require("largest position error as a share of the distance", this->positionError,
    tolerance::positionError, { this->position });
  require("share of pixels with a wrong normal", share(this->normal.size(), this->covered),
    tolerance::normalShare, { this->normal });
  for (std::size_t i = 0; i < this->lights.size(); ++i)
  {
    const auto& [counted, falseLight, falseShadow, unlit] = this->lights[i];
    const std::string name = "visibility." + std::to_string(i);
    require(name + ": share of wrong pixels",
      share(falseLight.size() + falseShadow.size(), counted), tolerance::visibilityShare,
      { falseLight, falseShadow });
    require(name + ": share of pixels that cannot be lit but are",
      share(unlit.size(), this->covered), tolerance::visibilityShare, { unlit });
  }
  return sentences;
}

Result compare(const Scene& scene, const VisibilityFile& file)
{
  const Comparison comparison(scene, file);
  const auto width = static_cast<std::size_t>(file.width);
  const auto height = static_cast<std::size_t>(file.height);
  std::vector<PixelResult> found(width * height);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, height),
    [&](const tbb::blocked_range<std::size_t>& rows)
    {
      for (std::size_t pixel = rows.begin() * width; pixel < rows.end() * width; ++pixel)
      {
        found[pixel] = comparison.compare(pixel);
      }
    });
  Result result;
  result.pixels = found.size();
  result.lights.resize(scene.lights.size());
  for (std::size_t pixel = 0; pixel < found.size(); ++pixel)
  {
    add(result, pixel, found[pixel]);
  }
  return result;
}

const std::vector<float>& VisibilityFile::channel(const std::string& name) const
{
  const auto place = this->channels.find(name);
  if (place == this->channels.end())
  {
    throw std::runtime_error("channel " + name + " is missing");
  }
  return place->second;
}

Vec3 VisibilityFile::vector(const std::string& name, std::size_t pixel) const
{
  return { this->channel(name + ".X")[pixel], this->channel(name + ".Y")[pixel],
    this->channel(name + ".Z")[pixel] };
}

VisibilityFile readVisibilityFile(const std::string& path)
{
  Imf::InputFile input(path.c_str());
  const Imf::Header& header = input.header();
  const Imath::Box2i window = header.dataWindow();
  VisibilityFile file;
  file.width = window.max.x - window.min.x + 1;
  file.height = window.max.y - window.min.y + 1;
  const auto* origin = header.findTypedAttribute<Imf::V3dAttribute>("origin");
  if (!origin)
  {
    throw std::runtime_error(path + ": the header has no attribute origin of type v3d");
  }
  file.origin = origin->value();

  const auto width = static_cast<std::size_t>(file.width);
  Imf::FrameBuffer frame;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
  {
    if (channel.channel().type != Imf::FLOAT)
    {
      throw std::runtime_error(path + ": channel " + channel.name() + " is not 32-bit float");
    }
    std::vector<float>& plane = file.channels[channel.name()];
    plane.resize(width * static_cast<std::size_t>(file.height));
    frame.insert(channel.name(),
      Imf::Slice::Make(Imf::FLOAT, plane.data(), window, sizeof(float), sizeof(float) * width));
  }
  input.setFrameBuffer(frame);
  input.readPixels(window.min.y, window.max.y);
  return file;
}

} // namespace gnomon::check
