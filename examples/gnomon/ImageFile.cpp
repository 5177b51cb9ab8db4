#include "ImageFile.h"

#include "Errors.h"
#include "VtkMessages.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
Picture capture(vtkRenderWindow* window)
{
  Picture picture;
  picture.width = window->GetSize()[0];
  picture.height = window->GetSize()[1];
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, picture.width - 1, picture.height - 1, 1, pixels);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int y = picture.height - 1; y >= 0; --y)
  {
    const unsigned char* begin = pixels->GetPointer(0) + row * static_cast<std::size_t>(y);
    picture.rgb.insert(picture.rgb.end(), begin, begin + row);
  }
  return picture;
}

//------------------------------------------------------------------------------
void writePicture(const Picture& picture, const std::string& path)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  auto* target = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int y = 0; y < picture.height; ++y)
  {
    std::copy_n(picture.rgb.data() + row * static_cast<std::size_t>(y), row,
      target + row * static_cast<std::size_t>(picture.height - 1 - y));
  }
  VtkMessages messages;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(path.c_str());
  writer->Write();
  if (!messages.errors().empty())
  {
    throw Failure(path + ": cannot be written: " + messages.errors().front());
  }
}

//------------------------------------------------------------------------------
void writeVisibility(const gnomon::VisibilityImages&, const std::string& path,
  const std::map<std::string, std::string>&)
{
  throw Failure(path + ": this build cannot write EXR files");
}

} // namespace gnomon::tool
