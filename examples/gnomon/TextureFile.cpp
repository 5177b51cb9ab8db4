#include "TextureFile.h"

#include "Errors.h"
#include "Files.h"
#include "ImageCheck.h"
#include "ModelChecks.h"

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkPNGReader.h>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readImage(const std::string& path)
{
  const std::string bytes = readWholeFile(path, largestModelBytes);
  if (!isWholeImage(bytes))
  {
    throw BadInput(path + ": not a PNG or JPEG image, or a damaged one");
  }
  vtkSmartPointer<vtkImageReader2> reader;
  if (imageType(bytes) == "image/png")
  {
    reader = vtkSmartPointer<vtkPNGReader>::New();
  }
  else
  {
    reader = vtkSmartPointer<vtkJPEGReader>::New();
  }
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkTexture> readTexture(const std::string& path)
{
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(readImage(path));
  return texture;
}

} // namespace gnomon::tool
