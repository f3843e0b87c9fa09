// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// Picture of the creature: as it is, rounded, and rounded with the defaults. It guards that
/// surfaces and their normals reach the screen. VTK's measure of pictures does not see a Roundness
/// of .9 for 1; positions have tests of their own.
#include "FilterTesting.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

using namespace FilterTesting;

namespace
{
void AddToScene(vtkRenderer* renderer, vtkAlgorithmOutput* surface, double x, const Vector& color)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(x, 0.0, 0.0);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  renderer->AddActor(actor);
}
}

int TestSphericalStyleFilterImage(int argc, char* argv[])
{
  char* path = vtkTestUtilities::ExpandDataFileName(argc, argv, "creature.vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path);
  delete[] path;
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(reader->GetOutputPort());
  normals->SplittingOff();
  vtkNew<vtkSphericalStyleFilter> rounded;
  rounded->SetInputConnection(reader->GetOutputPort());
  SetUpEnergy(rounded);
  rounded->SetRoundness(1.0);
  rounded->GenerateNormalsOn();
  vtkNew<vtkSphericalStyleFilter> made;
  made->SetInputConnection(reader->GetOutputPort());
  made->GenerateNormalsOn();
  reader->Update();
  const double width = 0.75 * Diagonal(reader->GetOutput());

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  AddToScene(renderer, normals->GetOutputPort(), 0.0, { 0.75, 0.75, 0.75 });
  AddToScene(renderer, rounded->GetOutputPort(), width, { 0.9, 0.6, 0.4 });
  AddToScene(renderer, made->GetOutputPort(), 2.0 * width, { 0.5, 0.7, 0.9 });
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(660, 220);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(0.0, 0.2, 1.0);
  renderer->ResetCamera();
  camera->Zoom(2.6);
  window->Render();

  const int result = vtkRegressionTestImageThreshold(window, SPHERICALSTYLE_IMAGE_LIMIT);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
}
