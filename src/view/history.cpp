#include "view/history.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

#include "view/inspection.h"

namespace talus::view {

HistoryInstant instant_of(const Frame& frame, const ContactKey& contact) {
  HistoryInstant instant;
  instant.time = frame.time;
  instant.tilt = frame.tilt;
  if (const auto found = contact_of_key(frame.contacts, contact)) {
    const auto c = static_cast<std::size_t>(*found);
    instant.fn = frame.contacts.fn[c];
    instant.ft = frame.contacts.ft[c];
    instant.status = frame.contacts.status[c];
    instant.friction = friction_of_contact(frame, *found);
  }
  return instant;
}

HistorySeries::HistorySeries(ReadFrame read)
    : read_(std::move(read)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

void HistorySeries::set_contact(const ContactKey& contact, std::size_t frames) {
  const std::scoped_lock lock(shared_.mutex);
  if (!(contact == contact_) || shared_.turn == 0) {
    contact_ = contact;
    instants_.clear();
    ++shared_.turn;
    shared_.contact = contact;
    shared_.ready.clear();
  }
  if (shared_.frames != frames || instants_.empty()) shared_.changed.notify_all();
  shared_.frames = frames;
}

bool HistorySeries::collect_ready() {
  const std::scoped_lock lock(shared_.mutex);
  if (shared_.ready.empty()) return false;
  std::ranges::move(shared_.ready, std::back_inserter(instants_));
  shared_.ready.clear();
  return true;
}

void HistorySeries::work(const std::stop_token& stop) {
  int turn = 0;
  std::size_t next = 0;
  bool failed = false;
  ContactKey contact;
  std::unique_lock lock(shared_.mutex);
  for (;;) {
    const bool anything = shared_.changed.wait(
        lock, stop, [&] { return shared_.turn != turn || (turn > 0 && !failed && next < shared_.frames); });
    if (!anything || stop.stop_requested()) return;
    if (shared_.turn != turn) {
      turn = shared_.turn;
      contact = shared_.contact;
      next = 0;
      failed = false;
      continue;
    }
    lock.unlock();
    HistoryInstant instant;
    try {
      instant = instant_of(*read_(next), contact);
    } catch (const std::exception&) {
      failed = true;  // the series of frames meets the same error and reports it
    }
    lock.lock();
    if (shared_.turn != turn || failed) continue;
    shared_.ready.push_back(instant);
    ++next;
  }
}

std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, double weight,
                                const PlotAbscissa& abscissa) {
  PlotSeries normal{"f_n", {}, {}}, tangential{"f_t", {}, {}}, mobilisation{"|f_t|/μf_n", {}, {}},
      sliding{"slides", {}, {}, true};
  for (const HistoryInstant& at : instants) {
    const double x = place_on(abscissa, at.tilt, at.time);
    for (PlotSeries* series : {&normal, &tangential, &mobilisation, &sliding}) series->x.push_back(x);
    normal.y.push_back(at.fn / weight);
    tangential.y.push_back(at.ft / weight);
    mobilisation.y.push_back(mobilised(at.fn, at.ft, at.friction));
    sliding.y.push_back(1.0);
  }
  std::vector<Plot> plots = {
      plot_along_run("contact forces", "f/mg", {std::move(normal), std::move(tangential)}),
      plot_along_run("mobilisation", "", {std::move(mobilisation), std::move(sliding)})};
  name_axis(abscissa.axis, plots);
  return plots;
}

}  // namespace talus::view
