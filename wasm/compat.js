// For resolvers that do not look at package.json's exports, such as Parcel's.
export * from './dist/compat.js';
