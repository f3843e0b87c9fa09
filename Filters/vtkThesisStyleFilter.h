// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkThesisStyleFilter
 * @brief   for study: vtkSphericalStyleFilter with the choices that the thesis leaves open
 *
 * Single steps of the method of the thesis, where vtkSphericalStyleFilter has ReproduceThesis for
 * all of them together. Nobody who wants to round a model needs them. With their defaults this is
 * vtkSphericalStyleFilter. ConcaveEdges Flip or Zero and InitialGuess Rest minimize the energy, as
 * SphericalWeighting Uniform does. ReproduceThesis overrides Acceleration, Anchor,
 * ComponentCoupling and InitialGuess.
 *
 * Output port 0 has one more point array on demand: CellEnergy.
 *
 * @sa vtkSphericalStyleFilter vtkNonlinearStyleFilter
 */
#ifndef vtkThesisStyleFilter_h
#define vtkThesisStyleFilter_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkSetRangeMacro.h"            // for its macro
#include "vtkSphericalStyleFilter.h"

class SPHERICALSTYLEFILTERS_EXPORT vtkThesisStyleFilter : public vtkSphericalStyleFilter
{
public:
  static vtkThesisStyleFilter* New();
  vtkTypeMacro(vtkThesisStyleFilter, vtkSphericalStyleFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum ConcaveEdgeModes
  {
    KEEP = 0,
    FLIP = 1,
    ZERO = 2
  };
  enum Anchors
  {
    CENTROID = 0,
    LAST_POINT = 1
  };
  enum ComponentCouplings
  {
    STITCHED = 0,
    INDEPENDENT = 1
  };
  enum InitialGuesses
  {
    BLEND = 0,
    REST = 1
  };

  ///@{
  /**
   * What happens to edges whose target points against them on the rest shape (only where
   * NormalBlend > 0, targets are given, or the Target is no Sphere): Keep (default), Flip
   * (Eq. 4.39: convex gets more convex, concave more concave) or Zero (no target, the edge
   * shrinks).
   */
  vtkSetRangeMacro(ConcaveEdges, int, KEEP, ZERO);
  vtkGetMacro(ConcaveEdges, int);
  void SetConcaveEdgesToKeep() { this->SetConcaveEdges(KEEP); }
  void SetConcaveEdgesToFlip() { this->SetConcaveEdges(FLIP); }
  void SetConcaveEdgesToZero() { this->SetConcaveEdges(ZERO); }
  ///@}

  ///@{
  /**
   * Anderson acceleration (window 5) with StopRule Converged: fewer iterations, and the energy
   * still never rises. Default on.
   */
  vtkSetMacro(Acceleration, bool);
  vtkGetMacro(Acceleration, bool);
  vtkBooleanMacro(Acceleration, bool);
  ///@}

  ///@{
  /**
   * What stays in place, of the whole model, or with the energy per connected component: Centroid
   * (default; the mean of its points, each with a third of the rest area of its triangles) or
   * LastPoint (thesis: the last point of the component).
   */
  vtkSetRangeMacro(Anchor, int, CENTROID, LAST_POINT);
  vtkGetMacro(Anchor, int);
  void SetAnchorToCentroid() { this->SetAnchor(CENTROID); }
  void SetAnchorToLastPoint() { this->SetAnchor(LAST_POINT); }
  ///@}

  ///@{
  /**
   * What holds parts together that share no edge (eyeballs in a head, panels of a car): Stitched
   * (default; near points of different parts are joined by edges, so that parts travel and turn
   * with their surroundings and the whole model has one anchor) or Independent (thesis; nothing:
   * each part has an anchor of its own and goes its own way). Of the energy only: in closed form
   * what lies within a cell of the grid moves as one anyway.
   */
  vtkSetRangeMacro(ComponentCoupling, int, STITCHED, INDEPENDENT);
  vtkGetMacro(ComponentCoupling, int);
  void SetComponentCouplingToStitched() { this->SetComponentCoupling(STITCHED); }
  void SetComponentCouplingToIndependent() { this->SetComponentCoupling(INDEPENDENT); }
  ///@}

  ///@{
  /**
   * Where an iteration starts: Blend (default; every rotation the identity, one global step, not
   * counted) or Rest (thesis; the unmoved points).
   */
  vtkSetRangeMacro(InitialGuess, int, BLEND, REST);
  vtkGetMacro(InitialGuess, int);
  void SetInitialGuessToBlend() { this->SetInitialGuess(BLEND); }
  void SetInitialGuessToRest() { this->SetInitialGuess(REST); }
  ///@}

  ///@{
  /**
   * Solve coincident points as one, so that texture seams and split normals do not open. Points are
   * never removed from the output. Default on.
   */
  vtkSetMacro(WeldCoincidentPoints, bool);
  vtkGetMacro(WeldCoincidentPoints, bool);
  vtkBooleanMacro(WeldCoincidentPoints, bool);
  ///@}

  ///@{
  /**
   * Add the point array CellEnergy, length^2, where an energy is minimized; a warning says so where
   * it is not. Default off.
   */
  vtkSetMacro(GenerateCellEnergy, bool);
  vtkGetMacro(GenerateCellEnergy, bool);
  vtkBooleanMacro(GenerateCellEnergy, bool);
  ///@}

protected:
  vtkThesisStyleFilter();
  ~vtkThesisStyleFilter() override;

private:
  vtkThesisStyleFilter(const vtkThesisStyleFilter&) = delete;
  void operator=(const vtkThesisStyleFilter&) = delete;
};

#endif
