#include "plugin/pass/Complaints.h"

#include <vtkCommand.h>
#include <vtkObject.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <iterator>

namespace gnomon
{

std::vector<std::string> Complaints::news(
  vtkRenderer* renderer, Topic topic, const std::vector<std::string>& texts)
{
  const auto erase = [this](const auto& isOver)
  {
    this->standing_.erase(std::remove_if(this->standing_.begin(), this->standing_.end(), isOver),
      this->standing_.end());
  };
  erase([](const Complaint& complaint) { return complaint.hasRenderer && !complaint.renderer; });
  const auto isKnown = [&](const std::string& text)
  {
    return std::any_of(this->standing_.begin(), this->standing_.end(),
      [&](const Complaint& complaint)
      { return complaint.topic == topic && complaint.text == text; });
  };
  std::vector<std::string> news;
  std::remove_copy_if(texts.begin(), texts.end(), std::back_inserter(news), isKnown);
  erase([&](const Complaint& complaint)
    { return complaint.topic == topic && complaint.renderer == renderer; });
  for (const std::string& text : texts)
  {
    this->standing_.push_back({ renderer, renderer != nullptr, topic, text });
  }
  return news;
}

std::string Complaints::news(vtkRenderer* renderer, Topic topic, const std::string& text)
{
  std::vector<std::string> texts;
  if (!text.empty())
  {
    texts.push_back(text);
  }
  texts = this->news(renderer, topic, texts);
  return texts.empty() ? std::string() : texts.front();
}

void Complaints::tellError(
  vtkObject* teller, vtkRenderer* renderer, Topic topic, const std::string& error)
{
  tell(teller, vtkCommand::ErrorEvent, this->news(renderer, topic, error));
}

void tell(vtkObject* teller, unsigned long event, const std::string& text)
{
  if (!text.empty() && teller->HasObserver(event))
  {
    teller->InvokeEvent(event, const_cast<char*>(text.c_str())); // as VTK's macros do
  }
  else if (!text.empty() && event == vtkCommand::ErrorEvent)
  {
    vtkErrorWithObjectMacro(teller, << text);
  }
  else if (!text.empty())
  {
    vtkWarningWithObjectMacro(teller, << text);
  }
}

} // namespace gnomon
