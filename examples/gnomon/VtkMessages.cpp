#include "VtkMessages.h"

#include "Text.h"

#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

namespace gnomon::tool
{

namespace
{

/// Return a message's text: "Text" for "ERROR: In /src/vtkReader.cxx, line 12" and "vtkReader
/// (0x55d0): Text" in two lines.
std::string withoutOrigin(const std::string& message)
{
  std::size_t begin = 0;
  const bool named = message.rfind("ERROR: In ", 0) == 0 || message.rfind("Warning: In ", 0) == 0 ||
    message.rfind("Generic Warning: In ", 0) == 0;
  if (named)
  {
    begin = message.find('\n');
    begin = begin == std::string::npos ? 0 : begin + 1;
    const std::size_t address = message.find("(0x", begin);
    const std::size_t colon = message.find("): ", begin);
    if (address != std::string::npos && colon != std::string::npos && address < colon)
    {
      begin = colon + 3;
    }
  }
  std::string text = oneLine(message.substr(begin));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

} // namespace

class VtkMessages::Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);

  void DisplayText(const char* text) override { this->warnings.push_back(withoutOrigin(text)); }
  void DisplayErrorText(const char* text) override { this->errors.push_back(withoutOrigin(text)); }
  void DisplayWarningText(const char* text) override { this->DisplayText(text); }
  void DisplayGenericWarningText(const char* text) override { this->DisplayText(text); }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};
vtkStandardNewMacro(VtkMessages::Window);

VtkMessages::VtkMessages()
  : window_(vtkSmartPointer<Window>::New())
  , previous_(vtkOutputWindow::GetInstance())
  , previousVerbosity_(vtkLogger::GetCurrentVerbosityCutoff())
{
  // VTK prints all messages twice: to its window and to its log.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(this->window_);
}

VtkMessages::~VtkMessages()
{
  vtkOutputWindow::SetInstance(this->previous_);
  vtkLogger::SetStderrVerbosity(this->previousVerbosity_);
}

const std::vector<std::string>& VtkMessages::errors() const
{
  return this->window_->errors;
}

const std::vector<std::string>& VtkMessages::warnings() const
{
  return this->window_->warnings;
}

} // namespace gnomon::tool
