#include "plugin/scene/PropNotes.h"

#include "vtkAlgorithm.h"
#include "vtkMapper.h"

namespace gnomon
{
namespace
{

struct Words
{
  const char* one;
  const char* many;
  const char* end = ""; ///< after the reason
};

/// Return the predicate of a kind's sentence, in the singular and the plural.
Words wordsOf(PropNotes::Kind kind)
{
  switch (kind)
  {
    case PropNotes::Kind::LeftOut:
      return { "neither casts nor receives, ", "neither cast nor receive, " };
    case PropNotes::Kind::Unlit:
      return { "is unlit and shows no shadow", "are unlit and show no shadow" };
    case PropNotes::Kind::NotCasting:
      return { "is translucent and casts nothing unless its key asks, or SetTranslucentCasters()",
        "are translucent and cast nothing unless their keys ask, or SetTranslucentCasters()" };
    case PropNotes::Kind::Volume:
      return { "is a volume and casts nothing unless its key asks, or SetVolumeCasters()",
        "are volumes and cast nothing unless their keys ask, or SetVolumeCasters()" };
    case PropNotes::Kind::Blocking:
      return { "casts as if opaque (", "cast as if opaque (", ")" };
    case PropNotes::Kind::Copied:
      break;
  }
  return { "is drawn into a framebuffer of its own and receives as if translucent",
    "are drawn into framebuffers of their own and receive as if translucent" };
}

} // namespace

void PropNotes::add(Kind kind, int number, vtkMapper* mapper, const std::string& why)
{
  constexpr int mostNames = 5;
  Named& named = this->props_[{ kind, why }];
  if (++named.count > mostNames)
  {
    return;
  }
  vtkAlgorithm* const source =
    mapper && mapper->GetNumberOfInputConnections(0) > 0 ? mapper->GetInputAlgorithm() : nullptr;
  named.names += (named.count > 1 ? ", " : "") + std::to_string(number) +
    (source && !source->IsA("vtkTrivialProducer") ? std::string(" (") + source->GetClassName() + ")"
                                                  : "");
}

void PropNotes::tell(DrawnProps& drawn) const
{
  for (const auto& [key, named] : this->props_)
  {
    const auto& [kind, why] = key;
    if (kind == Kind::LeftOut || kind == Kind::Volume)
    {
      drawn.leftOut.push_back(kind == Kind::LeftOut ? why : "vtkVolume (casts nothing)");
    }
    const Words words = wordsOf(kind);
    const bool isOne = named.count == 1;
    drawn.notes.push_back(std::to_string(named.count) + (isOne ? " prop " : " props ") +
      (isOne ? words.one : words.many) + why + words.end +
      (isOne ? ": view prop " : ": view props ") + named.names);
  }
  for (const auto& [why, count] : this->uncut_)
  {
    drawn.notes.push_back("holes in textures are not cut out of shadows: " + why + " (" +
      std::to_string(count) + (count == 1 ? " prop casts as a whole)" : " props cast as a whole)"));
  }
  if (this->moved_ > 0)
  {
    drawn.notes.push_back("shadows ignore shader code that may move vertices (" +
      std::to_string(this->moved_) + (this->moved_ == 1 ? " prop)" : " props)"));
  }
}

} // namespace gnomon
