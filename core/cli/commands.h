// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace toposcope::cli {

/// Each adds one command: its options, and what is done when it is given. `code` becomes the exit code of what was
/// done; errors leave as exceptions (base/errors.h).
void add_classify(CLI::App& app, int& code);
void add_compare(CLI::App& app, int& code);
void add_evaluate(CLI::App& app, int& code);
void add_export(CLI::App& app, int& code);
void add_label(CLI::App& app, int& code);
void add_model(CLI::App& app, int& code);
void add_plugins(CLI::App& app, int& code);
void add_prepare(CLI::App& app, int& code);
void add_render(CLI::App& app, int& code);
void add_report(CLI::App& app, int& code);
void add_run(CLI::App& app, int& code);
void add_sample(CLI::App& app, int& code);

/// Below `model`.
void add_model_ask(CLI::App& model, int& code);
void add_model_learn(CLI::App& model, int& code);
void add_model_new(CLI::App& model, int& code);
void add_model_probe(CLI::App& model, int& code);

/// Below `plugins`.
void add_plugins_check(CLI::App& plugins, int& code);
void add_plugins_new(CLI::App& plugins, int& code);

}  // namespace toposcope::cli
