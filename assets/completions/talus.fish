# Completion of talus for fish: the program names its commands, options and values; other words are file names.
function __talus_offers
    set -l words (commandline -opc)
    $words[1] complete-words $words[2..-1] "$(commandline -ct)" 2>/dev/null | string replace " " \t
end
complete -c talus -n 'test -n "$(__talus_offers)"' -f -a '(__talus_offers)'
