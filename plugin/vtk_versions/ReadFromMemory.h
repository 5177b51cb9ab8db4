#pragma once

#include "lights/vtkGnomonVersions.h"

#include "vtkImageReader2.h"
#if GNOMON_VTK_HAS_STREAMS
#include "vtkMemoryResourceStream.h"
#include "vtkNew.h"
#endif

#include <string>

namespace gnomon
{

/// Read a picture from the bytes of its file, for programs that receive pictures.
inline void readFromMemory(vtkImageReader2* reader, const std::string& bytes)
{
#if GNOMON_VTK_HAS_STREAMS
  vtkNew<vtkMemoryResourceStream> stream;
  stream->SetBuffer(bytes.data(), bytes.size());
  reader->SetStream(stream);
#else
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
  reader->SetMemoryBuffer(bytes.data());
#endif
  reader->Update();
}

} // namespace gnomon
