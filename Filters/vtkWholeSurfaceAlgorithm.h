// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWholeSurfaceAlgorithm
 * @brief   superclass of filters that need all of a surface, also where it is spread over processes
 *
 * With several processes (MPI) and a vtkPolyData at input port 0 of which another process than the
 * first has a part, the parts are gathered on the first process, the filter runs there once, and
 * each process gets its part of the result: its points, cells, order and arrays, vtkGhostType and
 * global ids included. The result is that of one process up to rounding. Filters that can do
 * without (vtkSphericalStyleFilter in closed form, vtkSurfaceMetrics, vtkGaussMapFilter) work on
 * all processes at once instead, each with its part; see RequestPart.
 *
 * Parts meet where they have points of the same global id, or, where a part has no global ids,
 * points with the same coordinates to the last bit. Of cells marked as duplicates in vtkGhostType
 * one takes part. With global ids of points and cells on all parts these come in their order, and
 * the result has the bits of one process.
 *
 * Point sets at further ports are gathered too. In a selection, ids are those of the part of each
 * process, as everywhere in VTK, and nodes with a PROCESS_ID are of that process. Outputs that are
 * not the input with other points or arrays (tables, spheres, proxies), and an output with other
 * cells than the input, are on the first process, and so are field data, the facts of an execution
 * and its messages; numbers in them are those of the gathered surface, unless they name a process.
 *
 * Blocks of composite data are never gathered: each process runs over the blocks that it has, in
 * any number. Before each execution the processes agree, with one message, whether there is
 * something to gather; so all of them have to execute (as ParaView does), and none waits for
 * another one in the middle of its blocks. What one process refuses is refused by all. A process
 * that fails before, in an upstream filter, leaves the others waiting, as with all filters that
 * communicate. Where there is one process, and whoever comes after asks for pieces, the whole is in
 * the first piece, and nothing in the others.
 *
 * @sa vtkAggregateDataSetFilter vtkRedistributeDataSetFilter vtkGenerateGlobalIds
 */
#ifndef vtkWholeSurfaceAlgorithm_h
#define vtkWholeSurfaceAlgorithm_h

#include "SphericalStyleFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for vtkSmartPointer

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <vector>     // for std::vector

class vtkMultiProcessController;
class vtkProcesses;

class SPHERICALSTYLEFILTERS_EXPORT vtkWholeSurfaceAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkWholeSurfaceAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The processes that the surface is spread over. Default: the global controller at the time of
   * construction. Set nullptr where each process works on a surface of its own.
   */
  virtual void SetController(vtkMultiProcessController*);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkWholeSurfaceAlgorithm();
  ~vtkWholeSurfaceAlgorithm() override;

  /// Whether the surface of this execution is in parts, the same on all processes.
  bool IsSpread() const;
  /// RequestData with the whole surface at port 0, or, on processes but the first, nothing.
  virtual int RequestWholeData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) = 0;

  /// What RequestPart has led to.
  enum PartOutcomes
  {
    WHOLE_IS_NEEDED, // the surface is gathered
    PART_FAILED,
    PART_DONE
  };
  /// RequestData on all processes at once, each with its part at port 0. All return the same. By
  /// default the whole is needed.
  virtual int RequestPart(vtkInformationVector**, vtkInformationVector*);
  /// The rest of RequestPart once it is agreed that parts will do. To be called by all.
  /// @param execute  talks to the others through `processes`; may throw
  /// @return PartOutcomes, the same on all; PART_FAILED with a message and empty outputs
  int RunOnParts(vtkInformationVector** inputs, vtkInformationVector* outputs,
    const vtkProcesses& processes, const std::function<void()>& execute);
  /// The same where no input is touched. @param hasPoints  whether this process has some of them
  int RunTogether(bool hasPoints, vtkInformationVector* outputs, const vtkProcesses& processes,
    const std::function<void()>& execute);

  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkMultiProcessController* Controller = nullptr;

private:
  vtkWholeSurfaceAlgorithm(const vtkWholeSurfaceAlgorithm&) = delete;
  void operator=(const vtkWholeSurfaceAlgorithm&) = delete;

  /// The pipeline tells the start and the end of each execution.
  static void NoteDepth(vtkObject* caller, unsigned long event, void*, void*);
  /// Once per execution, before the first block: all processes come here, whatever they have.
  void Agree();
  /// What goes to the first process, by port, nullptr for none to gather.
  /// @throw std::invalid_argument
  std::vector<vtkSmartPointer<vtkPolyData>> Prepare(vtkInformationVector** inputs);
  /// Prepare on all processes. @return whether none has failed
  bool PrepareAll(vtkInformationVector** inputs, std::vector<vtkSmartPointer<vtkPolyData>>& pieces);

  struct Internals; // what the processes agree on
  std::unique_ptr<Internals> Internal;
};

#endif
