// SPDX-License-Identifier: BSD-3-Clause
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include "rivals.h"

namespace toposcope::bench {

std::size_t read_vtk(const std::string& file) {
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return static_cast<std::size_t>(reader->GetOutput()->GetNumberOfPolys());
}

}  // namespace toposcope::bench
