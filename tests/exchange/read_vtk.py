"""Reads a .vtu, .vtp or .pvd-listed file with VTK and writes what VTK has of it: every array as raw bytes to
FOLDER/NAME, and counts and the volume as lines "NAME VALUE" on standard output. Ends with 77 where there is no VTK."""
import os
import sys

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    sys.exit(77)

path, folder = sys.argv[1:3]
reader = vtk.vtkXMLPolyDataReader() if path.endswith(".vtp") else vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
if reader.GetErrorCode() != 0:
    sys.exit(1)
data = reader.GetOutput()


def keep(name, array):
    with open(os.path.join(folder, name), "wb") as file:
        file.write(vtk_to_numpy(array).tobytes())


keep("Points", data.GetPoints().GetData())
for attributes in (data.GetPointData(), data.GetCellData(), data.GetFieldData()):
    for i in range(attributes.GetNumberOfArrays()):
        array = attributes.GetAbstractArray(i)
        if array.IsA("vtkStringArray"):
            words = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
            print(array.GetName(), ",".join(words))
        else:
            keep(array.GetName(), array)
print("points", data.GetNumberOfPoints())
print("cells", data.GetNumberOfCells())
print("types", ",".join(str(t) for t in sorted({data.GetCellType(i) for i in range(data.GetNumberOfCells())})))
if path.endswith(".vtu"):
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(data)
    sizes.Update()
    print("volume", repr(float(vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume")).sum())))
