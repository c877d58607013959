#include "signweave/head.h"
