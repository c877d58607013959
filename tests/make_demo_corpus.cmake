# Generates the demo corpus of meteo and villes (motion, annotation) and a database of it from scratch, and the same of
# mains and visage, whose hands and faces have times of their own, in the folder CHANNELS.
file(REMOVE_RECURSE ${FOLDER} ${FOLDER}.db ${CHANNELS} ${CHANNELS}.db)
foreach(command IN ITEMS "${SIGNER};${FOLDER};--minutes;2" "${PROGRAM};create;${FOLDER}.db" "${PROGRAM};import;${FOLDER}.db;${FOLDER}"
        "${SIGNER};${CHANNELS};--channels" "${PROGRAM};create;${CHANNELS}.db" "${PROGRAM};import;${CHANNELS}.db;${CHANNELS}")
  execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
