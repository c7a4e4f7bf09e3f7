#include "oneac/robust/graph_cut.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace oneac {
namespace {

using Vertex = std::uint32_t;
using FlowGraph =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                       boost::no_property, Vertex, std::uint32_t>;
using Edge = boost::graph_traits<FlowGraph>::edge_descriptor;

/// A directed edge before it has its place in the graph. Numbers 2k and 2k + 1 are each other's
/// reverse.
using Arc = std::pair<Vertex, Vertex>;

constexpr int kMaxCells = 1000;  // per axis; four axes fit a 64-bit key

/// In halves, so that the extent of the largest doubles does not overflow.
struct Box {
  Eigen::Vector2d half_low;
  Eigen::Vector2d half_size;
};

Box box_of_first_view(AcSpan acs) {
  Eigen::Vector2d low = acs[0].x1;
  Eigen::Vector2d high = acs[0].x1;
  for (const AffineCorrespondence& ac : acs) {
    low = low.cwiseMin(ac.x1);
    high = high.cwiseMax(ac.x1);
  }
  return {0.5 * low, 0.5 * high - 0.5 * low};
}

std::uint64_t append_cell(std::uint64_t key, const Eigen::Vector2d& x, const Box& box, int cells) {
  for (int axis = 0; axis < 2; ++axis) {
    const double size = box.half_size(axis);
    const double share = size > 0.0 ? (0.5 * x(axis) - box.half_low(axis)) / size : 0.0;
    const double cell = std::clamp(share * cells, 0.0, static_cast<double>(cells - 1));
    key = key * static_cast<std::uint64_t>(cells) + static_cast<std::uint64_t>(cell);
  }
  return key;
}

// An error that is no number (coordinates that overflow) belongs to no inlier.
double likelihood(double squared_error) {
  return squared_error >= 0.0 ? std::exp(-0.5 * squared_error) : 0.0;
}

}  // namespace

NeighbourPairs grid_neighbours(AcSpan acs, int cells) {
  if (cells < 1 || cells > kMaxCells) {
    throw std::invalid_argument("grid_neighbours: cells = " + std::to_string(cells) +
                                ", must be from 1 to " + std::to_string(kMaxCells));
  }
  NeighbourPairs pairs;
  if (acs.empty()) return pairs;
  const Box box = box_of_first_view(acs);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(acs.size());
  for (std::uint32_t i = 0; i < acs.size(); ++i) {
    order.emplace_back(append_cell(append_cell(0, acs[i].x1, box, cells), acs[i].x2, box, cells),
                       i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t a = 0; a < order.size(); ++a) {
    const std::size_t end = std::min(order.size(), a + 1 + kMaxNeighbours);
    for (std::size_t b = a + 1; b < end && order[b].first == order[a].first; ++b) {
      pairs.emplace_back(order[a].second, order[b].second);
    }
  }
  return pairs;
}

struct SpatialCut::Graph {
  Graph(std::size_t size, const NeighbourPairs& pairs, double lambda);
  void set_capacities(const std::vector<double>& squared_errors);
  void cut();

  std::size_t size;
  NeighbourPairs neighbours;
  double weight;
  FlowGraph flow;
  std::vector<std::uint32_t> place;  ///< edge index of each arc
  std::vector<Edge> reverse;
  std::vector<double> likelihoods, towards_inlier;
  std::vector<double> capacity, residual;
  std::vector<Edge> predecessor;
  std::vector<boost::default_color_type> colour;
  std::vector<long> distance;
};

SpatialCut::Graph::Graph(std::size_t n, const NeighbourPairs& pairs, double lambda)
    : size(n), neighbours(lambda > 0.0 ? pairs : NeighbourPairs{}), weight(lambda) {
  const auto source = static_cast<Vertex>(size);
  const auto sink = static_cast<Vertex>(size + 1);
  std::vector<Arc> arcs;
  arcs.reserve(4 * size + 2 * neighbours.size());
  const auto connect = [&](Vertex a, Vertex b) {
    arcs.push_back({a, b});
    arcs.push_back({b, a});
  };
  for (Vertex p = 0; p < size; ++p) {  // arcs 4p … 4p + 3
    connect(p, sink);
    connect(source, p);
  }
  for (const auto& [p, q] : neighbours) connect(p, q);

  // Sorted by their start, in the order they came: a counting sort.
  std::vector<std::uint32_t> next(size + 3, 0);
  for (const Arc& arc : arcs) ++next[arc.first + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Arc> sorted(arcs.size());
  place.resize(arcs.size());
  for (std::size_t id = 0; id < arcs.size(); ++id) {
    place[id] = next[arcs[id].first]++;
    sorted[place[id]] = arcs[id];
  }
  flow = FlowGraph(boost::edges_are_sorted, sorted.begin(), sorted.end(),
                   static_cast<Vertex>(size + 2), static_cast<std::uint32_t>(sorted.size()));
  reverse.resize(arcs.size());
  for (std::size_t id = 0; id < arcs.size(); ++id) {
    reverse[place[id]] = Edge(arcs[id].second, place[id ^ 1U]);
  }
  capacity.assign(arcs.size(), 0.0);
  residual.assign(arcs.size(), 0.0);
  predecessor.resize(size + 2);
  colour.resize(size + 2);
  distance.resize(size + 2);
  likelihoods.resize(size);
  towards_inlier.resize(size);
}

/// With two labels R is λ/2 [L_p ≠ L_q] plus, for each end that is an inlier, λ/2 − λ(K_p + K_q)/2.
void SpatialCut::Graph::set_capacities(const std::vector<double>& squared_errors) {
  for (std::size_t p = 0; p < size; ++p) {
    likelihoods[p] = likelihood(squared_errors[p]);
    towards_inlier[p] = 2.0 * likelihoods[p] - 1.0;  // B(outlier) − B(inlier)
  }
  for (std::size_t e = 0; e < neighbours.size(); ++e) {
    const auto& [p, q] = neighbours[e];
    const double gain = 0.5 * weight * (likelihoods[p] + likelihoods[q] - 1.0);
    towards_inlier[p] += gain;
    towards_inlier[q] += gain;
    const std::size_t id = 4 * size + 2 * e;
    capacity[place[id]] = capacity[place[id + 1]] = 0.5 * weight;
  }
  for (std::size_t p = 0; p < size; ++p) {  // the source's side is the inliers'
    capacity[place[4 * p]] = std::max(-towards_inlier[p], 0.0);
    capacity[place[4 * p + 2]] = std::max(towards_inlier[p], 0.0);
  }
}

void SpatialCut::Graph::cut() {
  const auto edge = get(boost::edge_index, flow);
  const auto vertex = get(boost::vertex_index, flow);
  boost::boykov_kolmogorov_max_flow(flow, boost::make_iterator_property_map(capacity.begin(), edge),
                                    boost::make_iterator_property_map(residual.begin(), edge),
                                    boost::make_iterator_property_map(reverse.begin(), edge),
                                    boost::make_iterator_property_map(predecessor.begin(), vertex),
                                    boost::make_iterator_property_map(colour.begin(), vertex),
                                    boost::make_iterator_property_map(distance.begin(), vertex),
                                    vertex, static_cast<Vertex>(size),
                                    static_cast<Vertex>(size + 1));
}

SpatialCut::SpatialCut(std::size_t size, const NeighbourPairs& neighbours, double weight)
    : graph_(std::make_unique<Graph>(size, neighbours, weight)) {}

SpatialCut::~SpatialCut() = default;

std::size_t SpatialCut::label(const std::vector<double>& squared_errors,
                              std::vector<std::uint8_t>& labels) {
  graph_->set_capacities(squared_errors);
  const bool coupled = !graph_->neighbours.empty();
  if (coupled) graph_->cut();
  labels.resize(graph_->size);
  std::size_t count = 0;
  for (std::size_t p = 0; p < labels.size(); ++p) {
    const bool inlier =
        coupled ? graph_->colour[p] == boost::black_color : graph_->towards_inlier[p] > 0.0;
    labels[p] = inlier ? 1 : 0;
    count += labels[p];
  }
  return count;
}

}  // namespace oneac
