int beside = 1;
