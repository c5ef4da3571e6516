// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/reasoning.h"

namespace toposcope {

/// A question to an abstract model: "subject relation object", of which one may be asked for.
struct AbstractQuery {
  std::string text;                      ///< as it was asked
  std::optional<Index> subject, object;  ///< nothing: asked for
  std::string relation;                  ///< a link or the inverse of one; empty: everything about the subject
  int dimension = -1;                    ///< of what is asked for; -1: any
};

/// What an abstract model answers to whether something holds. A model says what is, seldom what is not.
enum class Verdict : std::uint8_t { yes, no, unsaid };

struct AbstractAnswer {
  AbstractQuery query;
  Verdict verdict = Verdict::unsaid;  ///< where nothing is asked for
  std::vector<Link> because;          ///< of a yes or a no; a no without links is of the objects' dimensions
  struct Found {
    std::string relation;  ///< of the subject to the object found, or of the object found to the query's object
    Consequence consequence;
  };
  std::vector<Found> found;  ///< where something is asked for
};

/// Reads a question:
///   what bounds the upper lobe?      what is the upper lobe bounded by?     which lines bound the upper lobe?
///   is the apex above the hilum?     upper-lobe bounded-by ?                ? part-of left-lung
///   what is the hilum?
/// An object may be called by its name, by the words that it begins with, or by any of its words: the shortest such
/// name is meant, and of several that are as short none. \throw UsageError  it is no question, or names what is not
/// there, with the nearest name
AbstractQuery read_query(const std::string& text, const Model& model);

AbstractAnswer answer(const AbstractQuery& query, const Model& model);

/// For a terminal, with what each answer follows from.
std::string to_text(const AbstractAnswer& answer, const Model& model);
/// One JSON object (schemas/answer.schema.json).
std::string to_json(const AbstractAnswer& answer, const Model& model);

}  // namespace toposcope
