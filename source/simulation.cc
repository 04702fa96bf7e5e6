namespace tread {}
