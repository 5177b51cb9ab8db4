#include "TextureFile.h"

#include "Errors.h"
#include "Files.h"
#include "ReadGuarded.h"

#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkPNGReader.h>

namespace gnomon::tool
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> readImage(const std::string& path)
{
  vtkSmartPointer<vtkImageReader2> reader;
  readGuarded(path, requireReadableFile(path),
    [&]
    {
      reader = vtkSmartPointer<vtkPNGReader>::New();
      if (!reader->CanReadFile(path.c_str()))
      {
        reader = vtkSmartPointer<vtkJPEGReader>::New();
      }
      if (!reader->CanReadFile(path.c_str()))
      {
        throw BadInput("not a PNG or JPEG image");
      }
      reader->SetFileName(path.c_str());
      reader->Update();
    });
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
