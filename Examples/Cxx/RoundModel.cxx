// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rounds a model and shows it beside the result, both colored by mean curvature.
#include "vtkSphericalStyleFilter.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCleanPolyData.h"
#include "vtkColorTransferFunction.h"
#include "vtkCurvatures.h"
#include "vtkGenericDataObjectReader.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSTLReader.h"
#include "vtkTriangleFilter.h"
#include "vtkWindowToImageFilter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace
{
constexpr const char* Usage =
  "usage: RoundModel MODEL [options, with their defaults in parentheses]\n"
  "  MODEL                     ply, stl, obj, vtk or vtp\n"
  "  --roundness NUMBER        0 or more: 0 is the model (1)\n"
  "                            5 is nearly a ball, if --normal-blend is 0\n"
  "  --detail-size NUMBER      0..0.2: details up to this fraction of the diagonal stay (.06)\n"
  "  --normal-blend NUMBER     0..1: 0: one ball, 1: every limb round by itself (.6)\n"
  "  --output FILE.vtp         write the result\n"
  "  --off-screen PICTURE.png  write a picture instead of opening a window";

using Options = std::map<std::string, std::string>;

Options Parse(int argc, char* argv[])
{
  Options options = { { "--roundness", "1" }, { "--detail-size", "0.06" },
    { "--normal-blend", "0.6" }, { "--output", "" }, { "--off-screen", "" }, { "MODEL", "" } };
  for (int i = 1; i < argc; ++i)
  {
    const bool named = std::string(argv[i]).rfind("--", 0) == 0;
    if (named ? options.count(argv[i]) == 0 || i + 1 == argc : !options["MODEL"].empty())
    {
      throw std::runtime_error("cannot use \"" + std::string(argv[i]) + "\" here\n" + Usage);
    }
    const std::string name = named ? argv[i++] : "MODEL";
    options[name] = argv[i];
  }
  return options;
}

double Number(const Options& options, const std::string& name)
{
  std::istringstream text(options.at(name));
  double value = 0.0;
  if (!(text >> value) || !text.eof())
  {
    throw std::runtime_error(name + ": \"" + text.str() + "\" is not a number");
  }
  return value;
}

template <typename Reader>
vtkSmartPointer<vtkPolyData> ReadWith(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0));
}

template <typename Writer>
void WriteWith(const std::string& file, vtkAlgorithmOutput* data)
{
  vtkNew<Writer> writer;
  writer->SetInputConnection(data);
  writer->SetFileName(file.c_str());
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw std::runtime_error(file + ": cannot be written");
  }
}

/// Chooses the reader by the file's extension.
vtkSmartPointer<vtkPolyData> Read(const std::string& file)
{
  static const std::map<std::string, vtkSmartPointer<vtkPolyData> (*)(const std::string&)>
    readers = { { "ply", ReadWith<vtkPLYReader> }, { "stl", ReadWith<vtkSTLReader> },
      { "obj", ReadWith<vtkOBJReader> }, { "vtk", ReadWith<vtkGenericDataObjectReader> },
      { "vtp", ReadWith<vtkXMLPolyDataReader> } };
  const auto reader = readers.find(file.substr(file.rfind('.') + 1));
  return reader != readers.end() ? reader->second(file) : nullptr;
}

/// The left (0) or right (1) half of the window: a surface in the colors of its mean curvature.
vtkRenderer* AddHalf(
  vtkRenderWindow* window, int side, vtkPolyData* surface, vtkScalarsToColors* colors)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  vtkNew<vtkCleanPolyData> clean; // vtkCurvatures would treat texture seams as borders
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->SetTolerance(0.0);
  vtkNew<vtkCurvatures> curvatures;
  curvatures->SetInputConnection(clean->GetOutputPort());
  curvatures->SetCurvatureTypeToMean();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(curvatures->GetOutputPort());
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->SetViewport(0.5 * side, 0.0, 0.5 * side + 0.5, 1.0);
  renderer->SetBackground(0.3, 0.3, 0.35);
  renderer->AddActor(actor);
  window->AddRenderer(renderer);
  return renderer; // the window keeps it
}

void Show(vtkSphericalStyleFilter* style, vtkPolyData* model, const std::string& picture)
{
  // Both halves use the same colors; a sphere of the filter's radius r has mean curvature 1 / r.
  const double range = 5.0 / style->GetEffectiveRadius();
  vtkNew<vtkColorTransferFunction> colors;
  colors->SetColorSpaceToDiverging();
  colors->AddRGBPoint(-range, 0.23, 0.30, 0.75);
  colors->AddRGBPoint(range, 0.71, 0.02, 0.15);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(1200, 600);
  window->SetOffScreenRendering(!picture.empty());
  vtkCamera* camera = AddHalf(window, 0, model, colors)->GetActiveCamera();
  vtkRenderer* right = AddHalf(window, 1, style->GetOutput(), colors);
  right->SetActiveCamera(camera);
  right->ResetCamera();
  if (!picture.empty())
  {
    vtkNew<vtkWindowToImageFilter> image;
    image->SetInput(window);
    return WriteWith<vtkPNGWriter>(picture, image->GetOutputPort());
  }
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(vtkNew<vtkInteractorStyleTrackballCamera>());
  interactor->Start();
}
}

int main(int argc, char* argv[])
try
{
  const Options options = Parse(argc, argv);
  const auto model = Read(options.at("MODEL"));
  if (!model || model->GetNumberOfPolys() + model->GetNumberOfStrips() == 0)
  {
    const std::string file = options.at("MODEL");
    throw std::runtime_error(file.empty() ? Usage : file + ": no surface could be read from it");
  }
  vtkNew<vtkSphericalStyleFilter> style;
  style->SetInputData(model);
  style->SetRoundness(Number(options, "--roundness"));
  style->SetDetailSize(Number(options, "--detail-size"));
  style->SetNormalBlend(Number(options, "--normal-blend"));
  style->Update();
  if (style->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error("the filter failed and has said why");
  }
  const double* center = style->GetEffectiveCenter();
  std::cout << "target sphere at " << center[0] << " " << center[1] << " " << center[2]
            << ", radius " << style->GetEffectiveRadius() << std::endl;
  if (!options.at("--output").empty())
  {
    WriteWith<vtkXMLPolyDataWriter>(options.at("--output"), style->GetOutputPort());
  }
  Show(style, model, options.at("--off-screen"));
  return EXIT_SUCCESS;
}
catch (const std::exception& error)
{
  std::cerr << "RoundModel: " << error.what() << std::endl;
  return EXIT_FAILURE;
}
