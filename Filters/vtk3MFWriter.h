// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtk3MFWriter
 * @brief   write a model as 3MF, for programs that prepare it for a 3D printer
 *
 * Writes .3mf as the 3MF core specification 1.4 has it: one object, its unit, its points and
 * triangles. Programs for printers (slicers) know from the unit how large it is, which .stl does
 * not say. No colors, textures or other arrays.
 *
 * Input: vtkPolyData, the model. Its triangles are written (polygons and strips are cut), also
 * those without an area, since the surface would be open without them; not those with a point
 * twice. Coincident points are one, and points of no triangle are left out. Coordinates are those
 * of the model, and their digits give back every bit of single and double precision.
 *
 * Programs for printers have z up. Where vtkPrintableFilter says that another axis of the model
 * points up (its field array UpAxis), the file places the model by a transform: z up, the lowest
 * point on z = 0, the middle of the bounds at x = y = 0. Otherwise it stays where it is.
 *
 * A slicer wants a closed surface whose faces are outward, as vtkPrintableFilter makes it. Where it
 * has border edges, edges of three or more faces, faces that disagree on the outside, or closed
 * parts that are inside out, a warning says so, with their number and the first point. The file is
 * written all the same, since slicers repair much of that. A warning also tells of a model that is
 * below 5 mm in the unit of the file.
 *
 * Errors: no FileName, an ending other than .3mf, no faces, what all filters refuse (points that
 * are not finite, ids out of range), more than 4 GB, a file that cannot be written. There is no
 * file then, or the one of before.
 *
 * Cost: some passes over the triangles and the compression: some seconds and 500 MB for a million
 * points.
 *
 * @sa vtkPrintableFilter vtkSTLWriter
 */
#ifndef vtk3MFWriter_h
#define vtk3MFWriter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkWriter.h"

class vtkPolyData;

class SPHERICALSTYLEFILTERS_EXPORT vtk3MFWriter : public vtkWriter
{
public:
  static vtk3MFWriter* New();
  vtkTypeMacro(vtk3MFWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Units
  {
    MICRON = 0,
    MILLIMETER = 1,
    CENTIMETER = 2,
    INCH = 3,
    FOOT = 4,
    METER = 5
  };

  ///@{
  /**
   * The file to write. It ends in .3mf.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The unit of the model's coordinates. Default millimeter.
   */
  vtkSetRangeMacro(Unit, int, MICRON, METER);
  vtkGetMacro(Unit, int);
  void SetUnitToMicron() { this->SetUnit(MICRON); }
  void SetUnitToMillimeter() { this->SetUnit(MILLIMETER); }
  void SetUnitToCentimeter() { this->SetUnit(CENTIMETER); }
  void SetUnitToInch() { this->SetUnit(INCH); }
  void SetUnitToFoot() { this->SetUnit(FOOT); }
  void SetUnitToMeter() { this->SetUnit(METER); }
  ///@}

  /// @return 1, or 0 after an error.
  int Write() override;

protected:
  vtk3MFWriter();
  ~vtk3MFWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtk3MFWriter(const vtk3MFWriter&) = delete;
  void operator=(const vtk3MFWriter&) = delete;

  /// @throw std::exception saying why there is no file
  void Execute(vtkPolyData* input);

  char* FileName = nullptr;
  int Unit = MILLIMETER;
};

#endif
