# Generates the demo corpus of meteo and villes (motion, annotation) and a database of it from scratch.
file(REMOVE_RECURSE ${FOLDER} ${FOLDER}.db)
foreach(command IN ITEMS "${SIGNER};${FOLDER};--minutes;2" "${PROGRAM};create;${FOLDER}.db" "${PROGRAM};import;${FOLDER}.db;${FOLDER}")
  execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
