// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Python access to power cells of weighted points, of given volumes and of labelled voxels.
#include <flexpm/yade/bindings/array_view.hpp>
#include <flexpm/yade/bindings/bindings.hpp>

#include <flexpm/kernel/labels/given_volumes.hpp>
#include <flexpm/kernel/labels/label_fit.hpp>
#include <flexpm/kernel/labels/label_guard.hpp>
#include <flexpm/kernel/labels/voxel_cells.hpp>

#include <memory>

namespace py = boost::python;

namespace flexpm_bindings {
namespace {

	using flexpm::WeightedCells;

	std::vector<flexpm::Vector> vectorsOf(const py::object& array, const char* name)
	{
		const InputArray<double> input(array, 2, name);
		if (input.size(1) != 3)
			throw std::invalid_argument(std::string(name) + " = rows of " + std::to_string(input.size(1)) + ", must be rows of 3; give x, y and z");
		std::vector<flexpm::Vector> result;
		for (std::size_t i = 0; i < input.size(0); ++i)
			result.push_back({ input.data()[3 * i], input.data()[3 * i + 1], input.data()[3 * i + 2] });
		return result;
	}

	template <class T> std::vector<T> valuesOf(const py::object& array, const char* name)
	{
		const InputArray<T> input(array, 1, name);
		return { input.data(), input.data() + input.size(0) };
	}

	py::object rowsOf(const std::vector<flexpm::Vector>& values)
	{
		return dense_view(reinterpret_cast<const double*>(values.data()), values.size(), 3, py::object(), Access::readOnly).attr("copy")();
	}

	flexpm::WeightedPoints weightedPoints(const py::object& points, const py::object& weights)
	{
		return { vectorsOf(points, "points"), valuesOf<double>(weights, "weights") };
	}

	std::shared_ptr<WeightedCells> weightedCells(py::object points, py::object weights, const flexpm::Solid& solid)
	{
		return std::make_shared<WeightedCells>(flexpm::weighted_cells(weightedPoints(points, weights), solid));
	}

	py::object vertices(const WeightedCells& cells) { return rowsOf(cells.complex.vertices); }
	py::object centroids(const WeightedCells& cells) { return rowsOf(cells.centroids); }
	py::object volumes(const WeightedCells& cells) { return copied(cells.volumes, 0); }

	/// Cells of each face, offsets of the faces among the corners, and corners.
	py::tuple faces(const WeightedCells& cells)
	{
		std::vector<int> pairs, offsets { 0 }, corners;
		for (const flexpm::CellFace& face : cells.complex.faces) {
			pairs.insert(pairs.end(), { face.first, face.second });
			corners.insert(corners.end(), face.corners.begin(), face.corners.end());
			offsets.push_back(static_cast<int>(corners.size()));
		}
		return py::make_tuple(copied(pairs, 2), copied(offsets, 0), copied(corners, 0));
	}

	py::object weightsOfVolumes(py::object points, py::object weights, const flexpm::Solid& solid, py::object volumes, double tolerance)
	{
		const auto given = weightedPoints(points, weights);
		return copied(flexpm::weights_of_volumes(given, solid, valuesOf<double>(volumes, "volumes"), tolerance), 0);
	}

	flexpm::VoxelGrid voxelGrid(const py::tuple& counts, const py::object& box)
	{
		const auto        rows = vectorsOf(box, "box");
		flexpm::VoxelGrid grid { {}, rows.at(0), rows.at(1) };
		for (int axis = 0; axis < 3; ++axis)
			grid.counts[axis] = py::extract<int>(counts[axis]);
		return grid;
	}

	flexpm::LabelScores labelScores(const py::tuple& start)
	{
		return { vectorsOf(start[0], "centres"), vectorsOf(start[1], "slopes"), valuesOf<double>(start[2], "levels") };
	}

	py::object cellsOfVoxels(py::object points, py::object weights, const WeightedCells& cells, py::tuple counts, py::object box)
	{
		return copied(flexpm::cells_of_voxels(weightedPoints(points, weights), cells.complex, voxelGrid(counts, box)), 0);
	}

	py::tuple fitLabels(py::tuple samples, py::tuple rivals, py::tuple start, py::tuple options)
	{
		const flexpm::LabelSamples given { vectorsOf(samples[0], "points"),
			                           valuesOf<int>(samples[1], "labels"),
			                           valuesOf<double>(samples[2], "weights"),
			                           valuesOf<int>(rivals[0], "offsets"),
			                           valuesOf<int>(rivals[1], "rivals") };
		flexpm::LabelFitOptions    how;
		how.temperature  = py::extract<double>(options[0]);
		how.size         = py::extract<double>(options[1]);
		const auto found = flexpm::fit_labels(given, labelScores(start), how);
		return py::make_tuple(rowsOf(found.slopes), copied(found.levels, 0));
	}

	py::tuple raiseLevels(py::tuple voxels, py::tuple rivals, py::tuple start, py::object least, int most)
	{
		const flexpm::LabelledGrid given { voxelGrid(py::extract<py::tuple>(voxels[0]), voxels[1]),
			                           valuesOf<int>(voxels[2], "labels"),
			                           valuesOf<int>(rivals[0], "offsets"),
			                           valuesOf<int>(rivals[1], "rivals"),
			                           py::extract<int>(voxels[3]) };
		const auto                 found = flexpm::raise_levels(given, labelScores(start), valuesOf<int>(least, "least"), most);
		return py::make_tuple(copied(found.levels, 0), found.reached);
	}

} // namespace

void register_label_bindings()
{
	py::class_<WeightedCells, std::shared_ptr<WeightedCells>>("WeightedCells", "Power cells of weighted points in a solid. Arrays are copies.", py::no_init)
	        .add_property("vertices", vertices, "Vertices, (n, 3) [m].")
	        .add_property("faces", faces, "Cells of each face (-1: outside), offsets of the faces in the list of corners, and this list.")
	        .add_property("volumes", volumes, "Volume of each cell; 0 for a hidden point [m^3].")
	        .add_property("centroids", centroids, "Centroid of each cell, (n, 3) [m].");
	py::def("weighted_cells",
	        weightedCells,
	        (py::arg("points"), py::arg("weights"), py::arg("solid")),
	        "Return the power cells of points with weights [m^2] in a solid. Points may lie outside, and weights may be negative.");
	py::def("weights_of_volumes",
	        weightsOfVolumes,
	        (py::arg("points"), py::arg("weights"), py::arg("solid"), py::arg("volumes"), py::arg("tolerance")),
	        "Return the weights [m^2] for which the cells of the points have the volumes [m^3]. weights: start, for which no point is hidden; tolerance: "
	        "largest relative error of a volume.");
	py::def("cells_of_voxels",
	        cellsOfVoxels,
	        (py::arg("points"), py::arg("weights"), py::arg("cells"), py::arg("counts"), py::arg("box")),
	        "Return the cell of the middle of each voxel, x fastest. counts: voxels along x, y, z; box: rows of the size of a voxel and of the lower "
	        "corner of "
	        "the first voxel [m].");
	py::def("fit_labels",
	        fitLabels,
	        (py::arg("samples"), py::arg("rivals"), py::arg("start"), py::arg("options")),
	        "Fit scores 2 slope.(x - centre) + level to labels of voxels; return slopes and levels. samples: points, labels and weights of voxels; rivals: "
	        "offsets of each label and the labels that compete for its voxels; start: centres, slopes and levels; options: temperature and mean radius.");
	py::def("raise_levels",
	        raiseLevels,
	        (py::arg("voxels"), py::arg("rivals"), py::arg("start"), py::arg("least"), py::arg("most")),
	        "Raise levels of scores until each label has at least so many of its voxels; return the levels, and whether this is reached. "
	        "voxels: counts, box as for cells_of_voxels, the label of each voxel, and the first of the labels that share their voxels; "
	        "rivals, start: as for fit_labels; least: voxels of each label; most: raises for each label in the mean.");
}

} // namespace flexpm_bindings
