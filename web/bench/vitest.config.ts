import { defineConfig } from 'vitest/config';

export default defineConfig({ test: { include: ['bench/figures.ts'], testTimeout: 120000, hookTimeout: 60000, disableConsoleIntercept: true } });
