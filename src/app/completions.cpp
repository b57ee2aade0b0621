#include "app/completions.h"

#include <fmt/core.h>
#include <functional>

#include "base/text.h"

namespace talus::app {
namespace {

void for_each_command(const CommandPage& page, const std::function<void(const CommandPage&)>& visit) {
  visit(page);
  for (const CommandPage& command : page.commands) for_each_command(command, visit);
}

/// Returns its name without that of the program: "ensemble submit".
std::string words_of(const CommandPage& page) {
  const std::size_t blank = page.name.find(' ');
  return blank == std::string::npos ? "" : page.name.substr(blank + 1);
}

std::string names_of_commands(const CommandPage& page) {
  return joined(page.commands, " ", [](const CommandPage& command) { return last_word(command.name); });
}

std::string names_of_options(const CommandPage& page) {
  std::string names;
  for (const OptionPage& option : page.options)
    for (const std::string& name : option.names) names.append(names.empty() ? "" : " ").append(name);
  return names;
}

std::string replaced(const std::string& text, const std::string& found, const std::string& by) {
  std::string result = text;
  for (std::size_t at = result.find(found); at != std::string::npos; at = result.find(found, at + by.size()))
    result.replace(at, found.size(), by);
  return result;
}

/// Escapes text for use inside single quotes of a shell.
std::string in_quotes(const std::string& text) { return replaced(text, "'", "'\\''"); }

}  // namespace

std::string bash_completion(const CommandPage& program) {
  std::string paths, cases, values;
  for_each_command(program, [&](const CommandPage& page) {
    const std::string words = words_of(page);
    for (const CommandPage& command : page.commands)
      paths += fmt::format("{}\"{} {}\"", paths.empty() ? "" : " | ", words, last_word(command.name));
    cases += fmt::format("    \"{}\") commands='{}' options='{}' ;;\n", words, names_of_commands(page),
                         names_of_options(page));
    for (const OptionPage& option : page.options)
      if (!option.choices.empty())
        for (const std::string& name : option.names)
          values += fmt::format("    \"{} {}\") values='{}' ;;\n", words, name, joined(option.choices, " "));
  });
  return fmt::format(R"(# Completion of {0} for bash, made by {0}.
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command='' commands='' options='' values='' k
  for ((k = 1; k < COMP_CWORD; ++k)); do
    case "$command ${{COMP_WORDS[k]}}" in
      {1}) command="${{command:+$command }}${{COMP_WORDS[k]}}" ;;
    esac
  done
  case $command in
{2}  esac
  case "$command $previous" in
{3}  esac
  if [[ -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  fi
}}
complete -o default -F _{0} {0}
)",
                     program.name, paths, cases, values);
}

namespace {

/// Escapes text for the brackets of _arguments.
std::string zsh_text(const std::string& text) {
  std::string result = replaced(first_clause(text), "\\", "\\\\");
  for (const char* special : {"[", "]", ":"}) result = replaced(result, special, std::string("\\") + special);
  return in_quotes(result);
}

std::string zsh_option(const OptionPage& option) {
  const std::string value = option.value.empty() ? ""
                            : !option.choices.empty()
                                ? fmt::format(":{}:({})", zsh_text(option.value), joined(option.choices, " "))
                                : fmt::format(":{}:_files", zsh_text(option.value));
  if (option.names.empty()) return fmt::format(" \\\n    '*:{}:_files'", zsh_text(option.argument));
  std::string specs;
  for (const std::string& name : option.names)
    specs += fmt::format(" \\\n    '{}[{}]{}'", name, zsh_text(option.description), value);
  return specs;
}

std::string zsh_function_name(const CommandPage& page) { return "_" + replaced(page.name, " ", "_"); }

std::string zsh_function(const CommandPage& page) {
  std::string names, cases, specs;
  for (const CommandPage& command : page.commands) {
    names += fmt::format("    '{}:{}'\n", last_word(command.name), zsh_text(command.description));
    cases += fmt::format("      {}) {} ;;\n", last_word(command.name), zsh_function_name(command));
  }
  bool files = false;  // a single entry covers all arguments
  for (const OptionPage& option : page.options) {
    if (!option.names.empty() || !files) specs += zsh_option(option);
    files = files || option.names.empty();
  }
  const std::string function = zsh_function_name(page);
  if (page.commands.empty()) return fmt::format("{}() {{\n  _arguments{}\n}}\n\n", function, specs);
  return fmt::format(R"({0}() {{
  local -a commands=(
{1}  )
  local state
  if ((CURRENT > 2)) && [[ -n ${{commands[(r)$words[2]:*]}} ]]; then
    shift words
    ((CURRENT--))
    case $words[1] in
{2}    esac
  elif ((CURRENT == 2)) && [[ $words[2] != -* ]]; then
    _describe command commands{4}
  else
    _arguments{3}
  fi
}}

)",
                     function, names, cases, specs, files ? "\n    _files" : "");
}

}  // namespace

std::string zsh_completion(const CommandPage& program) {
  std::string text = fmt::format("#compdef {0}\n# Completion of {0} for zsh, made by {0}.\n\n", program.name);
  for_each_command(program, [&](const CommandPage& page) { text += zsh_function(page); });
  return text + fmt::format("_{0} \"$@\"\n", program.name);
}

namespace {

/// Returns the condition that a command is being typed.
std::string fish_condition(const CommandPage& page) {
  const std::string words = words_of(page);
  if (words.empty()) return "__fish_use_subcommand";
  return fmt::format("__fish_seen_subcommand_from {}",
                     replaced(words, " ", "; and __fish_seen_subcommand_from "));
}

std::string fish_option(const std::string& head, const OptionPage& option) {
  std::string line = head;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                   : fmt::format(" -s {}", name.substr(1));
  if (!option.choices.empty())
    line += fmt::format(" -x -a '{}'", joined(option.choices, " "));
  else if (!option.value.empty())
    line += " -r";
  return line + fmt::format(" -d '{}'\n", in_quotes(first_clause(option.description)));
}

}  // namespace

std::string fish_completion(const CommandPage& program) {
  std::string text = fmt::format("# Completion of {0} for fish, made by {0}.\n", program.name);
  for_each_command(program, [&](const CommandPage& page) {
    const std::string head = fmt::format("complete -c {} -n '{}'", program.name, fish_condition(page));
    for (const CommandPage& command : page.commands)
      text += fmt::format("{} {}-a {} -d '{}'\n", head, words_of(page).empty() ? "-f " : "",
                          last_word(command.name), in_quotes(first_clause(command.description)));
    for (const OptionPage& option : page.options)
      if (!option.names.empty()) text += fish_option(head, option);
  });
  return text;
}

}  // namespace talus::app
