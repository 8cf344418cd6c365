"""The particles of particle fields: their APIs, their arrays, their colour spaces."""
