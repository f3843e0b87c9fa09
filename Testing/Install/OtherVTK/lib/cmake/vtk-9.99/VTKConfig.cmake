# Never read: the version does not fit.
