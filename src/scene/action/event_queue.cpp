#include "scene/action/event_queue.h"

#include <cmath>

namespace parvis::action {
namespace {

std::string name_of(const scene::Node& node) {
  const bool is_named = node.schema->find("name") && node.gives("name");
  return is_named ? node.text("name") : "%" + node.schema->type;
}

}  // namespace

void EventQueue::warn(const std::string& kind, Error warning) {
  if (told_.insert(kind).second) warnings_.push_back(std::move(warning));
}

void EventQueue::post(Delivery delivery, double delay_s) {
  const std::string& text = delivery.message.text;
  const long step = now_ + std::lround(delay_s / step_s);
  delivery.chain = step > now_ ? 0 : next_chain_;
  if (delivery.chain > longest_chain) {
    const Error circle = error_at(delivery.where,
                                  "the message \"{}\" to \"{}\" causes itself without end: the circle was "
                                  "cut; give an event in it a delay",
                                  text, name_of(*delivery.target));
    return warn(to_string(circle), circle);
  }
  if (waiting_.size() >= max_waiting_messages)
    return warn("loss", error_at(delivery.where, "more than {} messages wait: \"{}\" to \"{}\" was lost",
                                 max_waiting_messages, text, name_of(*delivery.target)));
  waiting_.emplace(std::pair(step, posted_++), std::move(delivery));
}

bool EventQueue::next(Delivery& delivery) {
  next_chain_ = 0;
  if (now_ != counted_step_) counted_step_ = now_, delivered_ = 0;
  if (waiting_.empty() || waiting_.begin()->first.first > now_) return false;
  if (delivered_ == max_messages_per_step) {
    const Delivery& first = waiting_.begin()->second;
    warn("storm",
         error_at(
             first.where,
             "more than {} messages in one step, from \"{}\" to \"{}\" on: the others come in the next steps",
             max_messages_per_step, first.message.text, name_of(*first.target)));
    return false;
  }
  ++delivered_;
  delivery = std::move(waiting_.begin()->second);
  waiting_.erase(waiting_.begin());
  next_chain_ = delivery.chain + 1;
  return true;
}

}  // namespace parvis::action
