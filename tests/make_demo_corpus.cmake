# Generates recordings of the demo (motion, annotation) in FOLDER, with the options that select them, and a database of them
# beside it, from scratch.
file(REMOVE_RECURSE ${FOLDER} ${FOLDER}.db)
separate_arguments(OPTIONS)
foreach(command IN ITEMS "${SIGNER};${FOLDER};${OPTIONS}" "${PROGRAM};create;${FOLDER}.db" "${PROGRAM};import;${FOLDER}.db;${FOLDER}")
  execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
