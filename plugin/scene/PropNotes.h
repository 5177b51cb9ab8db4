#pragma once

#include "plugin/scene/DrawnProps.h"

#include <map>
#include <string>
#include <utility>

class vtkMapper;

namespace gnomon
{

/// Notes on what shadows leave out of props. Props of one kind and reason share a sentence, which
/// counts them and names the first ones.
class PropNotes
{
public:
  /// Kinds of props, in the order of their notes.
  enum class Kind
  {
    LeftOut, ///< neither cast nor receive
    Unlit,
    NotCasting, ///< translucent
    Volume,     ///< and casts nothing
    Blocking,   ///< translucent, but cast as if opaque
    Copied      ///< drawn into a framebuffer of its own
  };

  /// @param number of the prop in vtkRenderer::GetViewProps()
  /// @param mapper whose data's source is named; may be null
  /// @param why of kinds that have several reasons: a class and a reason, or a reason
  void add(Kind kind, int number, vtkMapper* mapper, const std::string& why = {});
  /// Add a prop that casts without its texture's holes.
  void addUncut(const std::string& why) { ++this->uncut_[why]; }
  /// Add a prop whose vertices shader code may move.
  void addMoved() { ++this->moved_; }

  /// Write the notes, and the classes that are left out.
  void tell(DrawnProps& drawn) const;

private:
  struct Named
  {
    int count = 0;
    std::string names; ///< of the first ones: numbers, with the data's sources
  };
  std::map<std::pair<Kind, std::string>, Named> props_; ///< by kind and reason
  std::map<std::string, int> uncut_;                    ///< by reason
  int moved_ = 0;
};

} // namespace gnomon
